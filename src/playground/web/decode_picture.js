/**
 * The texels of a picture file. PNG files are decoded here, to the bit; others by the browser, without colour management
 * or premultiplied alpha where it can.
 *
 * A 2D canvas stores premultiplied colours, which loses bits where alpha is below 255. A WebGL texture does not.
 */
import { messageOf } from './dom.js';
import { decodePng, isPng } from './png.js';

/** The largest file that may be dropped. */
export const mostBytes = 64 * 1024 * 1024;
const mostTexels = 4096 * 4096;

/** @param {ImageBitmap} bitmap @returns {Uint8Array|null} */
function throughWebgl(bitmap) {
  const { width, height } = bitmap;
  const gl = /** @type {any} */ (new OffscreenCanvas(1, 1).getContext('webgl2'));
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
  const context = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d'));
  context.drawImage(bitmap, 0, 0);
  return new Uint8Array(context.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer);
}

/** By the browser. @param {Blob} file */
async function decodeByBrowser(file) {
  let bitmap;
  try {
    bitmap = await createImageBitmap(file, { premultiplyAlpha: 'none', colorSpaceConversion: 'none' });
  } catch {
    throw new Error('the browser cannot decode it; expected a PNG, JPEG, WebP, GIF, AVIF or BMP picture');
  }
  const { width, height } = bitmap;
  if (width * height > mostTexels) throw new Error(`it has ${width} x ${height} texels; expected 4096 x 4096 at most`);
  const unchanged = throughWebgl(bitmap);
  const pixels = unchanged ?? throughCanvas(bitmap);
  bitmap.close();
  const lossy = !unchanged && pixels.some((value, at) => at % 4 === 3 && value < 255);
  return { width, height, pixels, doubt: lossy ? 'the browser decoded it and rounded the colours where alpha is below 255'
    : 'the browser decoded it, and another decoder may give other texels' };
}

/**
 * @param {Blob} file
 * @returns {Promise<{width: number, height: number, pixels: Uint8Array, doubt: string|null}>} RGBA8, rows from the top;
 *     `doubt`: why the texels may not be those that `ninebit` reads from the file
 */
export async function decodePicture(file) {
  if (file.size > mostBytes) {
    throw new Error(`the file has ${Math.round(file.size / 1e6)} MB; the page takes ${Math.round(mostBytes / 1e6)} MB at most`);
  }
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (!isPng(bytes)) return decodeByBrowser(file);
  try {
    return { ...await decodePng(bytes, mostTexels), doubt: null };
  } catch (error) {
    if (error instanceof RangeError) throw error;
    const found = await decodeByBrowser(file);
    return { ...found, doubt: `it is damaged (${messageOf(error)}); ${found.doubt}` };
  }
}
