export * from './goodbot_wasm.js';
