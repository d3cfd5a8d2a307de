// Calls of the package that give the same in Node and in a browser.

export const PROGRAM = `!!RC1.0
{ rgb { spare0 = col0 * tex0; scale_by_two(); } }
out.rgb = spare0;
out.a = tex0.a;
`;

/** Bytes that look random: a picture of `pixels` pixels. */
export function picture(pixels, seed) {
  let state = seed;
  return Uint8Array.from({ length: 4 * pixels }, () => {
    state = (state * 1103515245 + 12345) % 2147483648;
    return state >> 16;
  });
}

export const EFFECT = {
  ninebit: 'effect', version: 1, size: [32, 16],
  textures: { squares: { source: 'checker:8', filter: 'nearest' } },
  passes: [{ program: 'mine.rc1', units: [{ texture: 'squares' }], primary: 'constant:1,0.5,0.25' }],
};

export function answers(ninebit) {
  const drawing = ninebit.draw(EFFECT, { files: { 'mine.rc1': PROGRAM } });
  let refusal;
  try {
    ninebit.convert('!!RC1.0\nout.rgb = tex7;\n', 'glsl');
  } catch (error) {
    refusal = [error.name, error.line, error.message];
  }
  return {
    evaluated: [...ninebit.evaluate(PROGRAM, { tex0: picture(64, 1), primary: picture(64, 2) })],
    other: [...ninebit.evaluate(PROGRAM, { tex0: picture(64, 1) }, { profile: 'nv2a', registers: { primary: [9, 99, 200, 255] } })],
    converted: ninebit.convert(PROGRAM, 'gl'),
    pixel: ninebit.pixel(0, 0),
    form: ninebit.read(PROGRAM).form,
    size: [drawing.width, drawing.height],
    drawn: [...drawing.data],
    refusal,
  };
}
