/** A video of the part of the view that no panel covers, recorded by the browser. */

import { signal } from "@preact/signals";

import { freeArea, type Area } from "../../scene/free_area";
import type { SceneView } from "../../scene/scene_view";

const RATE = 30; // pictures per second
const BITS_PER_PIXEL = 4; // per second
/** Containers and codecs, the most widely played first. */
const TYPES = ["video/mp4;codecs=avc1.64003E", "video/mp4;codecs=avc1.42E01E", "video/mp4;codecs=vp9", "video/mp4", "video/webm;codecs=vp9", "video/webm"];

interface Running {
  readonly recorder: MediaRecorder;
  readonly parts: Blob[];
  readonly stop: () => void;
}

export class ViewVideo {
  /** When the recording began, by `performance.now`; null: none runs. */
  readonly since = signal<number | null>(null);
  private running: Running | null = null;

  constructor(private readonly scene: Pick<SceneView, "addStep" | "freeArea" | "invalidate" | "size">) {}

  /** Begin; throws a sentence where the browser records none. */
  start(): void {
    const type = typeof MediaRecorder === "undefined" ? undefined : TYPES.find((each) => MediaRecorder.isTypeSupported(each));
    if (type === undefined) throw new Error("This browser records no video; trundle render writes one of a camera.");
    const { canvas, draw } = this.makeCopy();
    const removeStep = this.scene.addStep({ after: (renderer) => draw(renderer.domElement) });
    const timer = setInterval(() => this.scene.invalidate(), 1000 / RATE); // also while nothing moves
    const recorder = new MediaRecorder(canvas.captureStream(RATE), {
      mimeType: type,
      videoBitsPerSecond: canvas.width * canvas.height * BITS_PER_PIXEL,
    });
    const parts: Blob[] = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    recorder.start(1000);
    this.running = {
      recorder,
      parts,
      stop: () => {
        clearInterval(timer);
        removeStep();
      },
    };
    this.since.value = performance.now();
  }

  /** End; resolves to the file. */
  async stop(): Promise<{ readonly content: Blob; readonly suffix: "mp4" | "webm" }> {
    const { running } = this;
    if (running === null) throw new Error("No video is being recorded.");
    const { recorder, parts, stop } = running;
    this.running = null;
    this.since.value = null;
    stop();
    if (recorder.state !== "inactive") {
      await new Promise((resolve) => {
        recorder.addEventListener("stop", resolve, { once: true });
        recorder.stop();
      });
    }
    const type = recorder.mimeType.split(";")[0] ?? "";
    return { content: new Blob(parts, { type }), suffix: type === "video/mp4" ? "mp4" : "webm" };
  }

  /** A canvas that takes the free part of each picture; its own size stays. */
  private makeCopy(): { readonly canvas: HTMLCanvasElement; readonly draw: (from: HTMLCanvasElement) => void } {
    const free = (): Area => {
      const { width, height } = this.scene.size.peek();
      return freeArea(width, height, this.scene.freeArea.peek());
    };
    const { width, height } = free();
    const canvas = Object.assign(document.createElement("canvas"), { width: even(width), height: even(height) });
    const context = canvas.getContext("2d", { alpha: false });
    const draw = (from: HTMLCanvasElement): void => {
      const area = free();
      const scale = from.width / this.scene.size.peek().width;
      context?.drawImage(
        from, area.left * scale, area.top * scale, area.width * scale, area.height * scale, 0, 0, canvas.width, canvas.height,
      );
    };
    return { canvas, draw };
  }
}

/** Device pixels of a length, an even number as codecs want it. */
function even(length: number): number {
  return Math.max(2, 2 * Math.floor((length * Math.min(2, window.devicePixelRatio)) / 2));
}
