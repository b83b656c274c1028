/** The canvas of the 3D view with its context of WebGL, which takes a browser long to begin. */

/** Most device pixels per pixel, and in the whole picture. */
const MAX_PIXEL_RATIO = 2;
const MAX_PIXELS = 5e6;
/** Most device pixels where the CPU draws. */
const MAX_SLOW_PIXELS = 1e6;

export interface DrawingCanvas {
  readonly element: HTMLCanvasElement;
  /** Null: this browser has no WebGL 2. */
  readonly context: WebGL2RenderingContext | null;
  /** True where the browser draws on the CPU: edges are not smoothed then. */
  readonly isSlow: boolean;
}

let begun: DrawingCanvas | null = null;

/** Begin the canvas that is asked for next, while the rest of the page is on its way. */
export function beginDrawing(): void {
  begun ??= create();
}

/** A canvas of its own for who draws. */
export function drawingCanvas(): DrawingCanvas {
  const canvas = begun ?? create();
  begun = null;
  return canvas;
}

/** Device pixels per pixel of a canvas [px]. */
export function pixelRatio(width: number, height: number, isSlow: boolean): number {
  return Math.min(
    window.devicePixelRatio,
    MAX_PIXEL_RATIO,
    Math.sqrt((isSlow ? MAX_SLOW_PIXELS : MAX_PIXELS) / (width * height)),
  );
}

function create(): DrawingCanvas {
  const slow = withContext(true);
  if (slow.context === null || drawsOnCpu(slow.context)) return slow;
  slow.context.getExtension("WEBGL_lose_context")?.loseContext(); // only at its creation can a context smooth edges
  return withContext(false);
}

/** As large as the window, which the scene fills: another size would wait for the browser's drawing. */
function withContext(isSlow: boolean): DrawingCanvas {
  const ratio = pixelRatio(innerWidth, innerHeight, isSlow);
  const element = Object.assign(document.createElement("canvas"), {
    width: Math.floor(innerWidth * ratio),
    height: Math.floor(innerHeight * ratio),
  });
  return {
    element,
    context: element.getContext("webgl2", { powerPreference: "high-performance", antialias: !isSlow }),
    isSlow,
  };
}

function drawsOnCpu(context: WebGL2RenderingContext): boolean {
  const name = context.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER;
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(context.getParameter(name)));
}
