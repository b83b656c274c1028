/** A video file that is written picture by picture. */

/** Pictures per second: of a video of the view, and the maximum of any video. */
export const RATE = 30;
const BITS_PER_PIXEL = 4; // per second
const MIN_BITRATE = 1e6; // bits per second

/** Video of one canvas, whose size must not change. */
export interface VideoFile {
  /** Remark for the person where the timing or format differs from an MP4 in simulated time; "": no difference. */
  readonly remark: string;
  /** True while the encoder accepts no picture. */
  readonly isBusy: boolean;
  /** Bytes written so far. */
  readonly size: number;
  /** Add the canvas' picture at a time since the beginning [s], later than the last picture's. */
  add(time: number): void;
  /** Finish the file; rejects with the encoder's error. */
  finish(): Promise<VideoContent>;
}

export interface VideoContent {
  readonly content: Blob;
  readonly suffix: "mp4" | "webm";
}

/** Bits per second for a canvas of this size. */
export function bitRate({ width, height }: HTMLCanvasElement): number {
  return Math.max(MIN_BITRATE, width * height * BITS_PER_PIXEL);
}
