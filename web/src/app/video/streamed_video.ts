/** A video by MediaRecorder, for browsers without WebCodecs: each picture has the time at which it is drawn. */

import { bitRate, RATE, type VideoContent, type VideoFile } from "./video_file";

/** Containers and codecs, the most widely played first. */
const TYPES = [
  "video/mp4;codecs=avc1.64003E",
  "video/mp4;codecs=avc1.42E01E",
  "video/mp4;codecs=vp9",
  "video/mp4",
  "video/webm;codecs=vp9",
  "video/webm",
];

export class StreamedVideo implements VideoFile {
  readonly remark: string;
  readonly isBusy = false;
  size = 0;
  private readonly parts: Blob[] = [];

  private constructor(
    private readonly recorder: MediaRecorder,
    private readonly suffix: VideoContent["suffix"],
  ) {
    this.remark =
      suffix === "mp4"
        ? "in the time of the clock"
        : "as WebM, in the time of the clock; MP4 needs a page from localhost or https";
    recorder.ondataavailable = ({ data }) => {
      this.parts.push(data);
      this.size += data.size;
    };
    recorder.start(1000);
  }

  /** Start a video of a canvas; throws a sentence if the browser cannot record. */
  static open(canvas: HTMLCanvasElement): StreamedVideo {
    const type =
      typeof MediaRecorder === "undefined" ? undefined : TYPES.find((type) => MediaRecorder.isTypeSupported(type));
    if (type === undefined) throw new Error("This browser records no video; trundle render writes one of a camera.");
    const recorder = new MediaRecorder(canvas.captureStream(RATE), {
      mimeType: type,
      videoBitsPerSecond: bitRate(canvas),
    });
    return new StreamedVideo(recorder, type.startsWith("video/mp4") ? "mp4" : "webm");
  }

  /** Nothing to do: the stream captures the canvas by itself. */
  add(): void {
    return;
  }

  async finish(): Promise<VideoContent> {
    const { recorder, suffix, parts } = this;
    if (recorder.state !== "inactive") {
      await new Promise((resolve) => {
        recorder.addEventListener("stop", resolve, { once: true });
        recorder.stop();
      });
    }
    return { content: new Blob(parts, { type: `video/${suffix}` }), suffix };
  }
}
