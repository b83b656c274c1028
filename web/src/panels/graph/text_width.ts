/** Width of text in the page's font [px]. */

const FALLBACK = 0.56; // width of a letter per font size, where there is no canvas

let context: CanvasRenderingContext2D | null | undefined;

export function textWidth(text: string, size: number): number {
  context ??= typeof document === "undefined" ? null : document.createElement("canvas").getContext("2d");
  if (context === null) return text.length * size * FALLBACK;
  context.font = `${size}px ${getComputedStyle(document.body).fontFamily}`;
  return context.measureText(text).width;
}
