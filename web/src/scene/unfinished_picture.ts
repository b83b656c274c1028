/** The picture that is being drawn. A browser that draws on the CPU is asked for the next one only when it is done. */

export class UnfinishedPicture {
  private sync: WebGLSync | null = null;

  constructor(private readonly context: WebGL2RenderingContext) {}

  /** Note that all of a picture has been asked for. */
  begin(): void {
    this.sync = this.context.fenceSync(this.context.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.context.flush();
  }

  isDone(): boolean {
    const { context, sync } = this;
    if (sync === null) return true;
    if (context.getSyncParameter(sync, context.SYNC_STATUS) === context.UNSIGNALED) return false;
    context.deleteSync(sync);
    this.sync = null;
    return true;
  }
}
