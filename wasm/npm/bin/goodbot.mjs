#!/usr/bin/env node
// Shows the trainer page in the browser: `npx goodbot [--port NUMBER] [--no-open]`. It answers this machine alone.
import { spawn } from 'node:child_process';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { parseArgs } from 'node:util';

const USAGE = 'usage: goodbot [--port NUMBER] [--no-open]';
const OPTIONS = { port: { type: 'string', default: '0' }, 'no-open': { type: 'boolean', default: false }, help: { type: 'boolean', short: 'h' } };

function given() {
  try {
    const { values } = parseArgs({ options: OPTIONS });
    if (!/^\d+$/.test(values.port) || values.port > 65535) throw new Error(`port ${values.port}: give a number from 0 to 65535; 0 is any that is free`);
    return values;
  } catch (error) {
    console.error(`${error.message}\n${USAGE}`);
    process.exit(2);
  }
}

const { port, 'no-open': stays, help } = given();
if (help) {
  console.log(USAGE);
  process.exit();
}
const page = await readFile(new URL('../goodbot.html', import.meta.url));
const server = createServer((request, response) => {
  const is = request.url === '/';
  response.writeHead(is ? 200 : 404, { 'content-type': is ? 'text/html; charset=utf-8' : 'text/plain' });
  response.end(is ? page : 'There is one page: /');
});
server.on('error', error => {
  console.error(`port ${port}: ${error.message}; choose another by --port, or none`);
  process.exit(1);
});
server.listen(Number(port), '127.0.0.1', () => {
  const address = `http://127.0.0.1:${server.address().port}/`;
  console.log(`the trainer page: ${address}   (Ctrl+C ends it)`);
  if (stays) return;
  const [program, ...before] = { darwin: ['open'], win32: ['cmd', '/c', 'start', ''] }[process.platform] ?? ['xdg-open'];
  spawn(program, [...before, address], { stdio: 'ignore', detached: true }).on('error', () => console.log('open it in your browser')).unref();
});
