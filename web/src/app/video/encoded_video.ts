/** An MP4 by the browser's own encoder, WebCodecs: each picture at its own time. */

import type { BufferTarget, CanvasSource, Mp4OutputFormat, Output } from "mediabunny";

import { sentence } from "../../panels/use";
import { bitRate, RATE, type VideoContent, type VideoFile } from "./video_file";

/** Codecs, the most widely supported first. */
const CODECS = ["avc", "vp9", "av1"] as const;

export class EncodedVideo implements VideoFile {
  readonly remark = "";
  private adding: Promise<void> | null = null;
  private fault: string | null = null;

  private constructor(
    private readonly output: Output<Mp4OutputFormat, BufferTarget>,
    private readonly source: CanvasSource,
    private readonly written: { bytes: number },
  ) {}

  get isBusy(): boolean {
    return this.adding !== null;
  }

  get size(): number {
    return this.written.bytes;
  }

  /** Null: the browser has no encoder, as on a page that comes by plain http over a network. */
  static async open(canvas: HTMLCanvasElement): Promise<EncodedVideo | null> {
    if (typeof VideoEncoder === "undefined") return null;
    const { BufferTarget, CanvasSource, getFirstEncodableVideoCodec, Mp4OutputFormat, Output, Quality } = await import(
      "mediabunny"
    );
    const quality = new Quality({ bitrate: bitRate(canvas) });
    const codec = await getFirstEncodableVideoCodec([...CODECS], {
      width: canvas.width,
      height: canvas.height,
      quality,
    });
    if (codec === null) return null;
    const output = new Output({ format: new Mp4OutputFormat({ fastStart: "in-memory" }), target: new BufferTarget() });
    const written = { bytes: 0 };
    const source = new CanvasSource(canvas, {
      codec,
      quality,
      onEncodedPacket: ({ byteLength }) => (written.bytes += byteLength),
    });
    output.addVideoTrack(source);
    await output.start();
    return new EncodedVideo(output, source, written);
  }

  add(time: number): void {
    this.adding = this.source.add(time, 1 / RATE).then(
      () => void (this.adding = null),
      (error: unknown) => void (this.fault = sentence(error)), // `adding` stays, so that no further picture comes
    );
  }

  async finish(): Promise<VideoContent> {
    await this.adding;
    if (this.fault !== null) {
      await this.output.cancel();
      throw new Error(this.fault);
    }
    await this.output.finalize();
    return { content: new Blob([this.output.target.buffer ?? ""], { type: "video/mp4" }), suffix: "mp4" };
  }
}
