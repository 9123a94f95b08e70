// Once more in Firefox: the tour tells the truth, and nothing is lost.
import { test } from 'node:test';
import { firefoxPath, takeFirefox } from './browser.mjs';

if (firefoxPath) {
  takeFirefox();
  await import('./tour.test.mjs');
  await import('./losing.test.mjs');
} else test('in Firefox, the tour and losing nothing', { skip: 'there is no Firefox' });
