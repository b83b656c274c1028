/** A video that is being recorded: pictures with their times go in, a file comes out. */

import { signal } from "@preact/signals";

import { EncodedVideo } from "./encoded_video";
import { StreamedVideo } from "./streamed_video";
import { RATE, type VideoContent, type VideoFile } from "./video_file";

const LARGEST = 1e9; // bytes: the file is in memory until it ends

export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

export class Recording {
  /** Length so far [s]. */
  readonly seconds = signal(0);
  readonly remark = signal("");
  private readonly canvas = document.createElement("canvas");
  private readonly context = this.canvas.getContext("2d", { alpha: false });
  private opening: Promise<VideoFile> | null = null;
  private file: VideoFile | null = null;
  private last: number | null = null;

  /** `onEnd` is called when the file can take no more pictures. */
  constructor(private readonly onEnd: () => void) {}

  /**
   * Add a picture at a time [s], unless the encoder is busy; the first picture sets the video's size. After a jump back
   * in time, the video continues.
   */
  add(
    image: CanvasImageSource,
    from: PictureSize & { readonly left: number; readonly top: number },
    time: number,
  ): void {
    this.opening ??= this.open(from);
    const { canvas, context, file, last } = this;
    if (file === null || file.isBusy || time === last) return;
    context?.drawImage(image, from.left, from.top, from.width, from.height, 0, 0, canvas.width, canvas.height);
    if (last !== null) this.seconds.value += time > last ? time - last : 1 / RATE;
    this.last = time;
    file.add(this.seconds.value);
    if (file.size > LARGEST) this.onEnd();
  }

  async finish(): Promise<VideoContent> {
    if (this.opening === null)
      throw new Error("No picture has come; a simulated camera draws while the simulation runs.");
    return (await this.opening).finish();
  }

  private async open({ width, height }: PictureSize): Promise<VideoFile> {
    Object.assign(this.canvas, { width: even(width), height: even(height) });
    const file = (await EncodedVideo.open(this.canvas)) ?? StreamedVideo.open(this.canvas);
    this.remark.value = file.remark;
    return (this.file = file);
  }
}

/** An even number of pixels, as codecs want it. */
function even(length: number): number {
  return Math.max(2, 2 * Math.floor(length / 2));
}
