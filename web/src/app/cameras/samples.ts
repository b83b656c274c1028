/**
 * Single pictures of a topic with pauses between them: a simulated camera is rendered only while somebody subscribes.
 */

import { effect, signal } from "@preact/signals";

import { drawPicture, PictureStream, type Picture, type PictureSource } from "../../displays/pictures/picture_stream";
import type { Connection } from "../../protocol/connection";

export class CameraSamples implements PictureSource {
  readonly picture = signal<Picture | null>(null);
  readonly fault = signal<string | null>(null);
  private stream: PictureStream | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private stopWatching = (): void => undefined;

  constructor(
    private readonly connection: Connection,
    private readonly topic: string,
    /** Pause after each picture [ms]. */
    private readonly pause: number,
  ) {
    this.take();
  }

  close(): void {
    clearTimeout(this.timer);
    this.rest();
  }

  private take(): void {
    const stream = new PictureStream(this.connection, this.topic);
    this.stream = stream;
    this.stopWatching = effect(() => {
      this.fault.value = stream.fault.value;
      const picture = stream.picture.value;
      if (picture === null) return;
      const image = document.createElement("canvas"); // closing the stream frees its own picture
      drawPicture(image, picture);
      this.picture.value = { ...picture, image };
      this.timer = setTimeout(() => this.take(), this.pause);
      queueMicrotask(() => this.rest()); // later, since the stream is still notifying
    });
  }

  private rest(): void {
    this.stopWatching();
    this.stream?.close();
    this.stream = null;
  }
}
