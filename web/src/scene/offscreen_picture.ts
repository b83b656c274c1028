/**
 * Picture that is drawn outside a context's canvas, and copied to the canvas when it is done.
 *
 * A browser that draws on the CPU reads a changed canvas back, which blocks the page until all drawing is done.
 * The canvas is resized together with the copy, so that it is never empty.
 */

export class OffscreenPicture {
  /** Canvas whose size, set by the renderer, is that of the picture being drawn. */
  readonly canvas: OffscreenCanvas;
  private readonly bind: WebGL2RenderingContext["bindFramebuffer"];
  private framebuffer: WebGLFramebuffer | null = null;
  private buffers: readonly (readonly [format: GLenum, buffer: WebGLRenderbuffer])[] = [];
  private width = 0;
  private height = 0;
  private samples = 0;
  /** Fence of the picture that is being drawn. */
  private sync: WebGLSync | null = null;

  /** Redirect the canvas' drawing into this picture. */
  constructor(private readonly context: WebGL2RenderingContext) {
    const choose = context.drawBuffers.bind(context);
    this.bind = context.bindFramebuffer.bind(context);
    context.bindFramebuffer = (target, framebuffer) => this.bind(target, framebuffer ?? this.framebuffer);
    context.drawBuffers = (buffers: Iterable<GLenum>) =>
      choose([...buffers].map((buffer) => (buffer === context.BACK ? context.COLOR_ATTACHMENT0 : buffer)));
    const { width, height } = context.canvas;
    this.canvas = new OffscreenCanvas(width, height);
    for (const name of ["webglcontextlost", "webglcontextrestored"]) {
      context.canvas.addEventListener(name, () => {
        if (name === "webglcontextrestored") this.create(); // before the renderer restarts
        this.canvas.dispatchEvent(new Event(name));
      });
    }
    this.create();
  }

  /** True while a picture is being drawn. */
  get isBegun(): boolean {
    return this.sync !== null;
  }

  /** Take the canvas' size, with a number of samples per pixel, 0: edges are not smoothed; a change clears the picture. */
  fit(samples: number): void {
    const { width, height } = this.canvas;
    if (width === this.width && height === this.height && samples === this.samples) return;
    [this.width, this.height, this.samples] = [width, height, samples];
    const { context } = this;
    for (const [format, buffer] of this.buffers) {
      context.bindRenderbuffer(context.RENDERBUFFER, buffer);
      context.renderbufferStorageMultisample(context.RENDERBUFFER, samples, format, width, height);
    }
    context.bindRenderbuffer(context.RENDERBUFFER, null);
  }

  /** Note that all drawing commands of a picture were issued; an unfinished earlier picture is dropped. */
  begin(): void {
    this.context.deleteSync(this.sync);
    this.sync = this.context.fenceSync(this.context.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.context.flush();
  }

  /** True if the picture is completely drawn. */
  isDone(): boolean {
    return (
      this.sync !== null &&
      this.context.getSyncParameter(this.sync, this.context.SYNC_STATUS) !== this.context.UNSIGNALED
    );
  }

  /** Copy the picture to the canvas; blocks the page if the picture is not done. */
  show(): void {
    const { context, width, height } = this;
    const { canvas } = context;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    this.bind(context.READ_FRAMEBUFFER, this.framebuffer);
    this.bind(context.DRAW_FRAMEBUFFER, null);
    context.blitFramebuffer(0, 0, width, height, 0, 0, width, height, context.COLOR_BUFFER_BIT, context.NEAREST);
    this.bind(context.FRAMEBUFFER, this.framebuffer);
    context.deleteSync(this.sync);
    this.sync = null;
  }

  private create(): void {
    const { context } = this;
    this.sync = null;
    this.framebuffer = context.createFramebuffer();
    this.bind(context.FRAMEBUFFER, this.framebuffer);
    const parts = [
      [context.COLOR_ATTACHMENT0, context.RGBA8],
      [context.DEPTH_ATTACHMENT, context.DEPTH_COMPONENT24],
    ] as const;
    this.buffers = parts.map(([attachment, format]) => {
      const buffer = context.createRenderbuffer();
      context.bindRenderbuffer(context.RENDERBUFFER, buffer);
      context.framebufferRenderbuffer(context.FRAMEBUFFER, attachment, context.RENDERBUFFER, buffer);
      return [format, buffer] as const;
    });
    this.width = this.height = 0;
    this.fit(this.samples);
  }
}
