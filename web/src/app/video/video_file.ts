/** A video file that is written picture by picture. */

/** Pictures per second of the view, and at most of a file. */
export const RATE = 30;
const BITS_PER_PIXEL = 4; // per second
const MIN_BITRATE = 1e6; // bits per second

/** Takes its pictures from one canvas, whose size stays. */
export interface VideoFile {
  /** Difference of its timing from an MP4's, for the person who records; "": none. */
  readonly remark: string;
  /** True while the encoder takes no picture. */
  readonly isBusy: boolean;
  /** Bytes written so far. */
  readonly size: number;
  /** Take the canvas' picture for a time since the beginning [s], later than the last one's. */
  add(time: number): void;
  /** End; rejects with the encoder's fault. */
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
