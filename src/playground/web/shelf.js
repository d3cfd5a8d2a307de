/**
 * The pictures and meshes that effects read: the gallery's pictures, which are part of the page, and what is dropped.
 */
import { decodePicture, mostBytes } from './decode_picture.js';
import { messageOf } from './dom.js';
import { fileName } from './files.js';
import { keepFile } from './kept.js';

/** Names of mesh files. */
export const meshEnding = /\.(gltf|glb|obj|ply|off)$/i;

/** The room: the engine has it. */
export const roomFile = 'index_room.gltf';

/** Matches the word before the file of a texture that is made from it. */
let madeFrom = /^$/;

/** The words, which the engine has. @param {string[]} words */
export const setFileOrigins = (words) => {
  madeFrom = new RegExp(`^(${words.join('|')}):`);
};

/** The file, or the six files, of a texture's source. @param {string} source */
export const fileIn = (source) => source.replace(madeFrom, '');

/** The names of the pictures that an effect reads. @param {any} effect @returns {string[]} */
const picturesOf = ({ textures }) => Object.values(textures ?? {}).flatMap(({ source }) => fileIn(source).split(','));

export class Shelf {
  /**
   * @param {import('./engine_client.js').Engine} engine
   * @param {Map<string, Uint8Array>} embedded files of the page by the names that effects give them
   */
  constructor(engine, embedded) {
    this.engine = engine;
    /** Keeps a dropped file for the next time that the page is loaded. */
    this.keepFile = keepFile;
    /** Hears that the browser did not keep one. */
    this.onlost = () => {};
    this.embedded = embedded;
    /** Small pictures to choose from, by name. @type {Map<string, {width: number, height: number, pixels: Uint8Array}>} */
    this.pictures = new Map();
    /** What was dropped, by name. @type {Map<string, Uint8Array>} */
    this.dropped = new Map();
    /** @type {Map<string, Promise<void>>} */
    this.loading = new Map();
    /** Why the texels of a picture may be others than the file's, by name. @type {Map<string, string>} */
    this.doubts = new Map();
  }

  /** Names of pictures to choose from. */
  names() {
    return [...this.embedded.keys(), ...[...this.dropped.keys()].filter((name) => !meshEnding.test(name))];
  }

  /** Names of meshes to choose from: the room, which the engine has, and what was dropped. */
  meshes() {
    return [roomFile, ...[...this.dropped.keys()].filter((name) => meshEnding.test(name))];
  }

  /** Puts a file of the page into the engine, once. @param {string} name */
  load(name) {
    const bytes = this.embedded.get(name);
    if (!bytes) return Promise.resolve();
    if (!this.loading.has(name)) {
      const loading = this.put(name, new Blob([/** @type {BlobPart} */ (bytes)]));
      this.loading.set(name, loading);
      // The next drawing tries again.
      loading.catch(() => this.loading.delete(name));
    }
    return this.loading.get(name);
  }

  /** The content of a file of the page or one that was dropped; `null`: there is none of that name. @param {string} name */
  bytesOf(name) {
    return this.dropped.get(name) ?? this.embedded.get(name) ?? null;
  }

  /** The room's file. @returns {Promise<Uint8Array>} */
  async room() {
    return (await this.engine.ask({ do: 'room' })).bytes;
  }

  /** Loads all files that an effect names. @param {any} effect */
  async loadFor(effect) {
    await Promise.all(picturesOf(effect).map((name) => this.load(name)));
  }

  /** What is not exact about the pictures that an effect names. @param {any} effect @returns {string[]} */
  doubtsOf(effect) {
    return picturesOf(effect).flatMap((name) => this.doubts.get(name) ?? []);
  }

  /** @param {string} name @param {Blob} file */
  async put(name, file) {
    if (meshEnding.test(name)) {
      await this.engine.put({ name, kind: 'file' }, new Uint8Array(await file.arrayBuffer()));
      return;
    }
    const picture = await decodePicture(file);
    this.pictures.set(name, picture);
    this.doubts.delete(name);
    if (picture.doubt) this.doubts.set(name, `${name}: ${picture.doubt}: the picture may differ from what ninebit draws`);
    await this.engine.put({ name, kind: 'pixels', width: picture.width, height: picture.height }, picture.pixels);
  }

  /**
   * Takes a dropped picture or mesh.
   * @param {File} file
   * @returns {Promise<string>} its name in effects
   */
  async take(file) {
    if (file.size > mostBytes) {
      throw new Error(`${file.name}: ${Math.round(file.size / 1e6)} MB; the page takes ${Math.round(mostBytes / 1e6)} MB at most`);
    }
    const bytes = new Uint8Array(await file.arrayBuffer());
    const name = this.nameFor(fileName(file.name), bytes);
    try {
      await this.put(name, file);
    } catch (error) {
      throw new Error(`${file.name}: ${messageOf(error)}`);
    }
    this.dropped.set(name, bytes);
    await this.keepFile(name, bytes).catch(() => this.onlost());
    return name;
  }

  /** A name that no other content has, so that a step back finds the old file. @param {string} file @param {Uint8Array} bytes */
  nameFor(file, bytes) {
    // The effect's words take no commas or colons in a file's name.
    const [, stem, ending] = /^(.*?)(\.[^.]*)?$/s.exec(file.replace(/[,:\\]/g, '_')) ?? ['', file];
    for (let number = 1; ; number++) {
      const name = `dropped/${stem}${number > 1 ? ` ${number}` : ''}${ending ?? ''}`;
      const there = this.dropped.get(name);
      if (!there || (there.length === bytes.length && there.every((byte, at) => byte === bytes[at]))) return name;
    }
  }

  /** Takes a file that was dropped before the page was loaded. @param {string} name @param {Uint8Array} bytes */
  async restore(name, bytes) {
    await this.put(name, new Blob([/** @type {BlobPart} */ (bytes)]));
    this.dropped.set(name, bytes);
  }
}
