// Joins the page's scripts and the module's glue into one small script: `node bundle.mjs GLUE OUT`.
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const [glue, outfile] = process.argv.slice(2);
await build({
  entryPoints: [fileURLToPath(new URL('../src/main.js', import.meta.url))],
  alias: { 'goodbot-wasm': resolve(glue) },
  // The glue's own way to fetch the module from beside itself is never taken.
  define: { 'import.meta.url': 'undefined' },
  bundle: true, format: 'iife', minify: true, charset: 'utf8', legalComments: 'none', logLevel: 'warning', outfile,
});
