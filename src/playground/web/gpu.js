/**
 * A program as GLSL ES, run by WebGL 2 on the texels of four textures: pixel (x, y) reads texel (x, y).
 */

const vertexShader = `#version 300 es
void main() {
  vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}`;

/** The end of the fragment shader: inputs as register codes, the result as bytes. */
const fragmentMain = `
uniform highp usampler2D ninebit_texture0;
uniform highp usampler2D ninebit_texture1;
uniform highp usampler2D ninebit_texture2;
uniform highp usampler2D ninebit_texture3;
uniform ivec4 ninebit_primary;
uniform ivec4 ninebit_fog;
uniform int ninebit_byte_shift;
out highp uvec4 ninebit_color;

ivec4 ninebit_codes(highp usampler2D from) {
  return ivec4(texelFetch(from, ivec2(gl_FragCoord.xy), 0)) >> ninebit_byte_shift;
}

// The byte of a code: low bits that a register drops are filled with the code's upper bits.
uint ninebit_byte(int code) {
  if (code >= 255 >> ninebit_byte_shift) return 255u;
  if (ninebit_byte_shift == 0) return uint(code);
  return uint((code << ninebit_byte_shift) | (code >> (8 - 2 * ninebit_byte_shift)));
}

void main() {
  ivec4 texture0 = ninebit_codes(ninebit_texture0);
  ivec4 secondary = ivec4(0, 0, 0, 255) >> ninebit_byte_shift;
  ivec4 color = ninebit_combine(ninebit_primary >> ninebit_byte_shift, secondary, ninebit_fog >> ninebit_byte_shift,
                                texture0, ninebit_codes(ninebit_texture1), ninebit_codes(ninebit_texture2),
                                ninebit_codes(ninebit_texture3), texture0.a);
  ninebit_color = uvec4(ninebit_byte(color.r), ninebit_byte(color.g), ninebit_byte(color.b), ninebit_byte(color.a));
}`;

function compiled(gl, kind, source) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(`the GPU’s compiler refuses it: ${gl.getShaderInfoLog(shader)}`);
  return shader;
}

function linked(gl, fragmentSource) {
  const program = gl.createProgram();
  gl.attachShader(program, compiled(gl, gl.VERTEX_SHADER, vertexShader));
  gl.attachShader(program, compiled(gl, gl.FRAGMENT_SHADER, fragmentSource));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`the GPU cannot link it: ${gl.getProgramInfoLog(program)}`);
  return program;
}

/** An integer texture, so that no filter or rounding touches the codes. */
function integerTexture(gl, unit, size, pixels) {
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8UI, size, size, 0, gl.RGBA_INTEGER, gl.UNSIGNED_BYTE, pixels);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
}

/**
 * @param {string} glsl what the engine emits as "glsl-es"
 * @param {{size: number, textures: Uint8Array[], primary: number[], fog: number[], byteShift: number}} inputs four textures of
 *     size x size RGBA8 texels; colours as bytes; how many low bits of a byte the profile drops
 * @returns {{pixels: Uint8Array, framesPerSecond: number, renderer: string}} rows in the order of the textures' rows
 */
export function runOnGpu(glsl, { size, textures, primary, fog, byteShift }) {
  const gl = new OffscreenCanvas(size, size).getContext('webgl2');
  if (!gl) throw new Error('the browser offers no WebGL 2 here');
  try {
    const program = linked(gl, glsl.replace('precision highp int;', 'precision highp int;\nprecision highp float;') + fragmentMain);
    gl.useProgram(program);
    textures.forEach((pixels, unit) => {
      integerTexture(gl, unit, size, pixels);
      gl.uniform1i(gl.getUniformLocation(program, `ninebit_texture${unit}`), unit);
    });
    gl.uniform4iv(gl.getUniformLocation(program, 'ninebit_primary'), primary);
    gl.uniform4iv(gl.getUniformLocation(program, 'ninebit_fog'), fog);
    gl.uniform1i(gl.getUniformLocation(program, 'ninebit_byte_shift'), byteShift);
    gl.activeTexture(gl.TEXTURE4);
    const target = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, target);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8UI, size, size);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
    gl.viewport(0, 0, size, size);
    const wide = new Uint32Array(size * size * 4);
    const read = () => gl.readPixels(0, 0, size, size, gl.RGBA_INTEGER, gl.UNSIGNED_INT, wide);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    read();
    if (gl.getError() !== gl.NO_ERROR) throw new Error('WebGL reports an error');
    const frames = 30;
    const begin = performance.now();
    for (let frame = 0; frame < frames; frame++) gl.drawArrays(gl.TRIANGLES, 0, 3);
    read();
    const framesPerSecond = frames * 1000 / Math.max(0.1, performance.now() - begin);
    const names = gl.getExtension('WEBGL_debug_renderer_info');
    const renderer = String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
    return { pixels: Uint8Array.from(wide), framesPerSecond, renderer };
  } finally {
    gl.getExtension('WEBGL_lose_context')?.loseContext();
  }
}
