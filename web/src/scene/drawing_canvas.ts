/** Canvas of the 3D view with its WebGL context, which a browser takes long to create. */

/** Largest number of device pixels per pixel, and in the whole picture. */
const MAX_PIXEL_RATIO = 2;
const MAX_PIXELS = 5e6;
/** Largest number of device pixels while the CPU draws changing pictures. */
const MAX_QUICK_PIXELS = 1e6;

export interface DrawingCanvas {
  readonly element: HTMLCanvasElement;
  /** Null: this browser has no WebGL 2. */
  readonly context: WebGL2RenderingContext | null;
  /** True where the browser draws on the CPU: its canvas does not smooth edges. */
  readonly isSlow: boolean;
}

let begun: DrawingCanvas | null = null;

/** Create the next canvas ahead of time, while the rest of the page loads. */
export function beginDrawing(): void {
  begun ??= create();
}

/** Canvas with a WebGL context, prepared or new. */
export function drawingCanvas(): DrawingCanvas {
  const canvas = begun ?? create();
  begun = null;
  return canvas;
}

/** Device pixels per pixel of a canvas [px]; fewer while the CPU draws changing pictures. */
export function pixelRatio(width: number, height: number, isQuick: boolean): number {
  return Math.min(
    window.devicePixelRatio,
    MAX_PIXEL_RATIO,
    Math.sqrt((isQuick ? MAX_QUICK_PIXELS : MAX_PIXELS) / (width * height)),
  );
}

function create(): DrawingCanvas {
  const slow = withContext(true);
  if (slow.context === null || drawsOnCpu(slow.context)) return slow;
  slow.context.getExtension("WEBGL_lose_context")?.loseContext(); // edge smoothing is fixed when a context is created
  return withContext(false);
}

/** Canvas as large as the window, which the scene fills, since a later resize would wait for the browser. */
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
