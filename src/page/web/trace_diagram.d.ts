// The types of trace_diagram.js, for modules that are checked.
export interface Drawn {
  count: number;
  step(n: number): void;
  remove(): void;
  light(ids: string[]): void;
}
export interface DiagramOptions {
  maxHeight?: string;
  explanation?: object;
  chosen?: (box: string | undefined) => void;
}
export function traceDiagram(container: HTMLElement, trace: object, options?: DiagramOptions): Drawn;
export function programDiagram(container: HTMLElement, program: object, options?: DiagramOptions): Drawn;
