// Once more in Firefox: the stage on screens of every size, the end of the tour, own words, and links.
import { test } from 'node:test';
import { firefoxPath, takeFirefox } from './browser.mjs';

if (firefoxPath) {
  takeFirefox();
  for (const file of ['access-sizes', 'ownway', 'replaying', 'studies']) await import('./' + file + '.test.mjs');
} else test('in Firefox, the stage', { skip: 'there is no Firefox' });
