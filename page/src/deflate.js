// Packs bytes and expands them, by the browser itself.

/** @param {Uint8Array} bytes */
export const packed = bytes => through(bytes, new CompressionStream('deflate-raw'));

/** @param {Uint8Array} bytes */
export const expanded = bytes => through(bytes, new DecompressionStream('deflate-raw'));

/** @param {Uint8Array} bytes
 * @param {GenericTransformStream} transform */
async function through(bytes, transform) {
  return new Uint8Array(await new Response(new Blob([/** @type {BlobPart} */ (bytes)]).stream().pipeThrough(transform)).arrayBuffer());
}
