// Once more in Firefox: the stage on screens of every size, and own words. Links are in firefox.test.mjs.
import { test } from 'node:test';
import { firefoxPath, takeFirefox } from './browser.mjs';

if (firefoxPath) {
  takeFirefox();
  for (const file of ['access-sizes', 'ownway']) await import('./' + file + '.test.mjs');
} else test('in Firefox, the stage', { skip: 'there is no Firefox' });
