// Once more in Firefox: the front door, and the moments in which something ends.
import { test } from 'node:test';
import { firefoxPath, takeFirefox } from './browser.mjs';

if (firefoxPath) {
  takeFirefox();
  for (const file of ['invention', 'moments']) await import('./' + file + '.test.mjs');
} else test('in Firefox, the front door', { skip: 'there is no Firefox' });
