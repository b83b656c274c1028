/**
 * Picture that is drawn beside a context's canvas, and copied to it when it is done.
 *
 * A browser that draws on the CPU reads a changed canvas back, and its page stands still until all drawing is done.
 */

export class OffscreenPicture {
  private readonly bind: WebGL2RenderingContext["bindFramebuffer"];
  private framebuffer: WebGLFramebuffer | null = null;
  private buffers: readonly (readonly [format: GLenum, buffer: WebGLRenderbuffer])[] = [];
  private width = 0;
  private height = 0;
  /** Fence of the picture that is being drawn. */
  private sync: WebGLSync | null = null;

  /** Redirect the canvas' drawing into this picture. */
  constructor(private readonly context: WebGL2RenderingContext) {
    const choose = context.drawBuffers.bind(context);
    this.bind = context.bindFramebuffer.bind(context);
    context.bindFramebuffer = (target, framebuffer) => this.bind(target, framebuffer ?? this.framebuffer);
    context.drawBuffers = (buffers: Iterable<GLenum>) =>
      choose([...buffers].map((buffer) => (buffer === context.BACK ? context.COLOR_ATTACHMENT0 : buffer)));
    context.canvas.addEventListener("webglcontextrestored", () => this.create()); // before the renderer restarts
    this.create();
  }

  /** True while a picture is drawn. */
  get isBegun(): boolean {
    return this.sync !== null;
  }

  /** Set the size [px]; a change clears the picture. */
  fit(width: number, height: number): void {
    if (width === this.width && height === this.height) return;
    [this.width, this.height] = [width, height];
    const { context } = this;
    for (const [format, buffer] of this.buffers) {
      context.bindRenderbuffer(context.RENDERBUFFER, buffer);
      context.renderbufferStorage(context.RENDERBUFFER, format, width, height);
    }
    context.bindRenderbuffer(context.RENDERBUFFER, null);
  }

  /** Note that all drawing of a picture was issued. */
  begin(): void {
    this.sync = this.context.fenceSync(this.context.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.context.flush();
  }

  /** True if the picture that was begun is drawn. */
  isDone(): boolean {
    return (
      this.sync !== null &&
      this.context.getSyncParameter(this.sync, this.context.SYNC_STATUS) !== this.context.UNSIGNALED
    );
  }

  /** Copy the picture to the canvas; the page waits if it is not done. */
  show(): void {
    const { context, width, height } = this;
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
    const { width, height } = this;
    this.width = this.height = 0;
    this.fit(width, height);
  }
}
