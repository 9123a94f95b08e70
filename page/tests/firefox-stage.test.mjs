// Once more in Firefox: the stage, whatever the screen's size, the end of the tour, own words, and what links bring.
import { test } from 'node:test';
import { firefoxPath, takeFirefox } from './browser.mjs';

if (firefoxPath) {
  takeFirefox();
  for (const file of ['access-sizes', 'ownway', 'replaying', 'studies']) await import('./' + file + '.test.mjs');
} else test('in Firefox, the stage', { skip: 'there is no Firefox' });
