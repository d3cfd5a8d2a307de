/** A profile's name, such as "geforce2" or "nv2a", or a profile file as an object. */
export type Profile = string | object;

/** Codes of a register: red, green, blue, alpha. 255 is 1.0 in most profiles. */
export type Codes = [number, number, number, number];

export interface Place {
  message: string;
  /** Which text the place is in: "text", "effect", "profile", "request" or a file's name. */
  file?: string;
  /** From 1. */
  line?: number;
  /** From 1, in UTF-16 units. */
  column?: number;
}

export class NinebitError extends Error {
  /** The message without its place. */
  reason: string;
  file?: string;
  line?: number;
  column?: number;
  /** Further faults of the same text. */
  others: Place[];
}

/** What is chosen of a text that leaves a choice: flags of `ninebit explain` by these names, and its `#N`. */
export interface Choice {
  /** The function of a source. */
  function?: string;
  /** Values that a source or a pixel shader does not give. */
  defines?: Record<string, string>;
  /** A program of a function that draws several times, or a set-up of a log, from 1. */
  program?: number;
}

/** Of a program's text: `files` has the texts that it includes, by names beside its own `name`. */
export interface Reading {
  profile?: Profile;
  name?: string;
  files?: Record<string, string>;
  choice?: Choice;
}

/** The choices that a text leaves. */
export interface Choices {
  /**
   * Of a source, the functions that set combiners. `name` is empty for code outside of functions; `helper`: its calls
   * depend on its parameters, and another function calls it; `needs`: names of values that the text does not give.
   */
  functions?: { name: string; line: number; helper: boolean; needs: string[] }[];
  /** How many programs the source's function draws with, or how many set-ups a log has. */
  programs?: number;
  /** Names on which conditions of a pixel shader depend and that nothing defines. */
  needs?: string[];
}

export interface Picture {
  width: number;
  height: number;
  /** RGBA, rows from the top. */
  data: Uint8Array;
}

export interface Drawing extends Record<string, unknown> {
  width: number;
  height: number;
  warnings: unknown[];
  /** RGBA, rows from the top. */
  data: Uint8Array;
}

/** All methods throw NinebitError for what the engine refuses. Equal calls give equal answers on every machine. */
export class Ninebit {
  /** Version, forms of programs, profiles with every field. */
  about(): Record<string, any>;
  /**
   * What a program is and computes: form, faults, explanation, the textures and constants that it reads, and the choices
   * that it leaves.
   */
  read(text: string, options?: Reading): Choices & Record<string, any>;
  /** The program in another form: "rc10", "ps11", "glsl", … as about() lists them. */
  convert(text: string, to: string, options?: Reading): string;
  /** Every stage of one fragment: the object of `ninebit trace --json`. */
  trace(text: string, options?: { profile?: Profile; registers?: Record<string, Codes> }): Record<string, any>;
  /**
   * A program on pictures of one size, texel by texel: by register, "tex0" to "tex3", "primary", …, RGBA of four bytes a
   * pixel. Returns the colours, in the same order.
   */
  evaluate(text: string, pictures: Record<string, Uint8Array | Uint8ClampedArray>,
           options?: { profile?: Profile; registers?: Record<string, Codes> }): Uint8Array;
  /** Keeps a picture, or a file's bytes (.gltf, .glb, .obj, .ply, .off), for effects that name it. */
  put(name: string, content: Picture | { data: Uint8Array }): void;
  /**
   * Draws an effect file, an object or a text. By name, `files` has the texts of its programs and of what they include,
   * `choices` what is chosen of them.
   */
  draw(effect: object | string, options?: {
    files?: Record<string, string>; choices?: Record<string, Choice>; profile?: Profile; size?: [number, number] }): Drawing;
  /** A pixel of the last drawing, from the top left: the object of `ninebit trace --effect --json`. */
  pixel(x: number, y: number): Record<string, any>;
  /** Any request of the engine, docs/playground_engine.md lists them, and its bytes. */
  ask(request: object, bytes?: Uint8Array): { answer: Record<string, any>; bytes: Uint8Array };
}

/** The engine. Each has its own memory. */
export function load(): Promise<Ninebit>;
