// The types of wrong_pixels.js, for modules that are checked.
export interface Row {
  plane: Uint8Array;
}
export interface Painter {
  pointsOf(row: Row, offset: number): HTMLCanvasElement;
  densityOf(row: Row, offset: number): Float32Array;
  heatOf(density: Float32Array, most: number): HTMLCanvasElement;
}
export const causeColors: Record<string, string>;
export const causeHelp: Record<string, string>;
export function wrongPixels(width: number, height: number, causes: string[]): Painter;
