/**
 * The texels of a picture file, decoded by the browser without colour management or premultiplied alpha.
 *
 * A 2D canvas stores premultiplied colours, which loses bits where alpha is below 255. A WebGL texture does not.
 */

/** The largest file that may be dropped. */
export const mostBytes = 64 * 1024 * 1024;
const mostTexels = 4096 * 4096;

/** @param {ImageBitmap} bitmap @returns {Uint8Array|null} */
function throughWebgl(bitmap) {
  const { width, height } = bitmap;
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2');
  if (!gl || width > gl.getParameter(gl.MAX_TEXTURE_SIZE) || height > gl.getParameter(gl.MAX_TEXTURE_SIZE)) return null;
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
  const texture = gl.getParameter(gl.TEXTURE_BINDING_2D);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  const pixels = new Uint8Array(width * height * 4);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const good = gl.getError() === gl.NO_ERROR;
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return good ? pixels : null;
}

/** @param {ImageBitmap} bitmap */
function throughCanvas(bitmap) {
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
  context.drawImage(bitmap, 0, 0);
  return new Uint8Array(context.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer);
}

/**
 * @param {Blob} file
 * @returns {Promise<{width: number, height: number, pixels: Uint8Array, exact: boolean}>} RGBA8, rows from the top;
 *     `exact`: false if alpha may have changed the colours
 */
export async function decodePicture(file) {
  if (file.size > mostBytes) {
    throw new Error(`the file has ${Math.round(file.size / 1e6)} MB; the page takes ${Math.round(mostBytes / 1e6)} MB at most`);
  }
  let bitmap;
  try {
    bitmap = await createImageBitmap(file, { premultiplyAlpha: 'none', colorSpaceConversion: 'none' });
  } catch {
    throw new Error('the browser cannot decode it; expected a PNG, JPEG, WebP, GIF, AVIF or BMP picture');
  }
  const { width, height } = bitmap;
  if (width * height > mostTexels) throw new Error(`it has ${width} x ${height} texels; expected 4096 x 4096 at most`);
  const exact = throughWebgl(bitmap);
  const pixels = exact ?? throughCanvas(bitmap);
  bitmap.close();
  return { width, height, pixels, exact: exact !== null };
}
