// Expands a page as its beginning does, and compares its module with the one that was packed: `node unpacking.mjs PAGE MODULE`.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { fromBase64 } from '../src/base64.js';
import { moduleOf } from '../src/module.js';
import { unpack } from '../src/unpack.js';

const [page, module] = process.argv.slice(2);
const [, sizes, packed] = readFileSync(page, 'utf8').match(/data-sizes="([\d ]+)">([^<]+)</) || [];
const counts = sizes.split(' ').map(Number);
const whole = unpack(fromBase64(packed.trim()), counts.reduce((sum, size) => sum + size));
let at = 0;
const parts = counts.map(size => whole.slice(at, at += size));
assert.ok(Buffer.from(moduleOf(parts.slice(4))).equals(readFileSync(module)), 'the module is not what was packed');
