/**
 * A program as GLSL ES, run by WebGL 2 on the registers of each pixel's fragment.
 */

const vertexShader = `#version 300 es
void main() {
  vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}`;

/** The registers in the order of `ninebit_combine`; of the last one it reads alpha. */
export const registers = ['primary', 'secondary', 'fog', 'texture0', 'texture1', 'texture2', 'texture3', 'spare0'];

/** The end of the fragment shader: inputs as register codes, the result as bytes. */
const fragmentMain = `
${registers.map((name) => `uniform highp isampler2D ninebit_${name};`).join('\n')}
uniform int ninebit_byte_shift;
out highp uvec4 ninebit_color;

// The byte of a code: low bits that a register drops are filled with the code's upper bits.
uint ninebit_byte(int code) {
  if (code >= 255 >> ninebit_byte_shift) return 255u;
  if (ninebit_byte_shift == 0) return uint(code);
  return uint((code << ninebit_byte_shift) | (code >> (8 - 2 * ninebit_byte_shift)));
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec4 color = ninebit_combine(${registers.slice(0, 7).map((name) => `texelFetch(ninebit_${name}, at, 0)`).join(',\n                                ')},
                                texelFetch(ninebit_spare0, at, 0).a);
  ninebit_color = uvec4(ninebit_byte(color.r), ninebit_byte(color.g), ninebit_byte(color.b), ninebit_byte(color.a));
}`;

/** @param {WebGL2RenderingContext} gl @param {number} kind @param {string} source */
function compiled(gl, kind, source) {
  const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(`the GPU’s compiler refuses it: ${gl.getShaderInfoLog(shader)}`);
  return shader;
}

/** @param {WebGL2RenderingContext} gl @param {string} fragmentSource */
function linked(gl, fragmentSource) {
  const program = gl.createProgram();
  gl.attachShader(program, compiled(gl, gl.VERTEX_SHADER, vertexShader));
  gl.attachShader(program, compiled(gl, gl.FRAGMENT_SHADER, fragmentSource));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`the GPU cannot link it: ${gl.getProgramInfoLog(program)}`);
  return program;
}

/** An integer texture, so that no filter or rounding touches the codes. @param {WebGL2RenderingContext} gl @param {number} unit @param {{width: number, height: number}} size @param {Int16Array} codes */
function integerTexture(gl, unit, { width, height }, codes) {
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16I, width, height, 0, gl.RGBA_INTEGER, gl.SHORT, codes);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
}

/**
 * @param {string} glsl what the engine emits as "glsl-es"
 * @param {{width: number, height: number, inputs: Int16Array[], byteShift: number}} fragments codes of `registers`, four a
 *     pixel; how many low bits of a byte the profile drops
 * @returns {{pixels: Uint8Array, framesPerSecond: number, renderer: string}} rows in the order of the inputs' rows
 */
export function runOnGpu(glsl, { width, height, inputs, byteShift }) {
  const gl = new OffscreenCanvas(width, height).getContext('webgl2');
  if (!gl) throw new Error('the browser offers no WebGL 2 here');
  try {
    const program = linked(gl, glsl.replace('precision highp int;', 'precision highp int;\nprecision highp float;') + fragmentMain);
    gl.useProgram(program);
    inputs.forEach((codes, unit) => {
      integerTexture(gl, unit, { width, height }, codes);
      gl.uniform1i(gl.getUniformLocation(program, `ninebit_${registers[unit]}`), unit);
    });
    gl.uniform1i(gl.getUniformLocation(program, 'ninebit_byte_shift'), byteShift);
    gl.activeTexture(gl.TEXTURE0 + inputs.length);
    const target = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, target);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8UI, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
    gl.viewport(0, 0, width, height);
    const wide = new Uint32Array(width * height * 4);
    const read = () => gl.readPixels(0, 0, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, wide);
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
