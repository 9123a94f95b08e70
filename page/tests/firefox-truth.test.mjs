// Once more in Firefox: what the tour says is true, and nothing is lost.
import { test } from 'node:test';
import { firefoxPath, takeFirefox } from './browser.mjs';

if (firefoxPath) {
  takeFirefox();
  await import('./tour.test.mjs');
  await import('./losing.test.mjs');
} else test('in Firefox, the tour and losing nothing', { skip: 'there is no Firefox' });
