// Joins the page's scripts into two small ones, the beginning and all others with the module's glue, and makes its style small: `node bundle.mjs GLUE BEGIN
// OTHERS STYLE VERSION`.
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const [glue, begin, others, style, version] = process.argv.slice(2);
const source = name => [fileURLToPath(new URL('../' + name, import.meta.url))];
const small = { bundle: true, format: 'iife', minify: true, charset: 'utf8', legalComments: 'none', logLevel: 'warning' };
await build({ ...small, entryPoints: source('src/begin.js'), outfile: begin });
await build({ ...small, entryPoints: source('style.css'), outfile: style });
await build({
  ...small, entryPoints: source('src/main.js'), outfile: others,
  alias: { 'goodbot-wasm': resolve(glue) },
  // The glue can fetch the module from its own folder; that code never runs here.
  define: { 'import.meta.url': 'undefined', GOODBOT_VERSION: JSON.stringify(version) },
});
