/**
 * Small pictures of textures that the engine makes: it draws them on a rectangle, or on a sphere where they are cubes.
 */

const side = 64;
const program = '!!RC1.0\nout.rgb = tex0;\nout.a = unsigned_invert(zero);\n';

/**
 * Whether the engine makes the texture of bytes: of its other makings, which only texture-shader stages read, the file is shown, and a
 * target has no picture before its pass is drawn.
 * @param {string} source
 */
export const isGenerated = (source) => /^(normals:|normalize-cube:|checker:|gradient$|falloff$)/.test(source);

export class GeneratedPictures {
  /**
   * @param {import('./engine_client.js').Engine} engine
   * @param {import('./shelf.js').Shelf} shelf
   */
  constructor(engine, shelf) {
    this.engine = engine;
    this.shelf = shelf;
    /** Pictures by source and steepness; `null`: it cannot be shown. @type {Map<string, Promise<{width: number, height: number, pixels: Uint8Array}|null>>} */
    this.made = new Map();
  }

  /** @param {any} texture of an effect */
  of(texture) {
    const { source, steepness } = texture;
    if (!isGenerated(String(source ?? ''))) return null;
    const key = JSON.stringify([source, steepness]);
    const found = this.made.get(key) ?? this.draw(source, steepness);
    this.made.set(key, found);
    // A later drawing may have the file that this one lacked.
    found.then((picture) => { if (!picture) this.made.delete(key); });
    return found;
  }

  /** @param {string} source @param {number} [steepness] */
  async draw(source, steepness) {
    const texture = { source, ...(steepness !== undefined && { steepness }) };
    const isCube = source.startsWith('normalize-cube') || source.split(',').length === 6;
    const effect = {
      ninebit: 'effect', version: 1, size: side, textures: { texture }, ...(isCube && { scene: { mesh: 'sphere:48' } }),
      passes: [{ program: 'texture.rc1', units: [{ texture: 'texture', coordinates: isCube ? 'position' : 'uv' }] }],
    };
    try {
      await this.shelf.loadFor(effect);
      // This request leaves the last drawing, which is that of the page, as it is.
      const { answer, bytes } = await this.engine.ask({ do: 'combiners', effect, files: { 'texture.rc1': program }, pass: 0 });
      const pixels = new Uint8Array(4 * side * side), from = 8 * side * side * answer.registers.length;
      // Its rows are from the lowest.
      for (let row = 0; row < side; row++) pixels.set(bytes.subarray(from + 4 * side * row, from + 4 * side * (row + 1)), 4 * side * (side - 1 - row));
      return { width: side, height: side, pixels };
    } catch {
      return null;
    }
  }
}
