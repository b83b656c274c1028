/** Pictures of an image topic, for displays, tiles and panels. */

import { signal, type ReadonlySignal } from "@preact/signals";

import type { Connection, Received, Subscription } from "../../protocol/connection";
import type { CompressedImage, Header, Image } from "../../protocol/generated/ros_messages";
import { decodePicture, type DecodePicture } from "./picture_decoder";
import { NO_HISTORY, type Normalization, type RangeHistory } from "./pixels";

/** A picture to draw on a canvas. */
export interface Picture {
  readonly image: ImageBitmap | HTMLCanvasElement;
  readonly width: number;
  readonly height: number;
  readonly header: Header;
}

/** Source of pictures for tiles and panels, such as Image and Camera displays. */
export interface PictureSource {
  readonly picture: ReadonlySignal<Picture | null>;
}

const TYPES = ["sensor_msgs/Image", "sensor_msgs/CompressedImage"];

/** Subscribes to a topic of images, raw or compressed. While one is decoded, only the newest waits. */
export class PictureStream implements PictureSource {
  readonly picture = signal<Picture | null>(null);
  /** Reason why the last image is not shown; null: shown. */
  readonly fault = signal<string | null>(null);
  /** Encoding of the last image, or its format where it is compressed. */
  readonly encoding = signal("");
  readonly count = signal(0);
  /** Conversion of numbers to grey, from the next image on. */
  normalization: Normalization = { isAutomatic: true, min: 0, max: 1, window: 5 };

  private readonly subscription: Subscription;
  private waiting: Image | CompressedImage | null = null;
  private isBusy = false;
  private isClosed = false;
  private history: RangeHistory = NO_HISTORY;

  constructor(
    connection: Connection,
    private readonly topic: string,
    private readonly decode: DecodePicture = decodePicture,
  ) {
    this.subscription = connection.subscribe<Image | CompressedImage>(topic, (received) => this.receive(received), {
      onError: (text) => (this.fault.value = text),
    });
  }

  close(): void {
    this.isClosed = true;
    this.subscription.close();
    this.replace(null);
  }

  private receive({ type, message }: Received<Image | CompressedImage>): void {
    if (!TYPES.includes(type)) {
      this.fault.value = `${this.topic} is of type ${type}, not ${TYPES.join(" or ")}`;
      return;
    }
    this.count.value += 1;
    this.waiting = message;
    if (!this.isBusy) void this.work();
  }

  private async work(): Promise<void> {
    this.isBusy = true;
    for (let message = this.next(); message !== null; message = this.next()) await this.show(message);
    this.isBusy = false;
  }

  private next(): Image | CompressedImage | null {
    const message = this.isClosed ? null : this.waiting;
    this.waiting = null;
    return message;
  }

  private async show(message: Image | CompressedImage): Promise<void> {
    try {
      this.encoding.value = "format" in message ? message.format : message.encoding;
      const { bitmap, history } = await this.decode(message, this.normalization, this.history);
      if (this.isClosed) {
        bitmap.close();
        return;
      }
      this.history = history;
      this.fault.value = null;
      this.replace({ image: bitmap, width: bitmap.width, height: bitmap.height, header: message.header });
    } catch (error) {
      this.fault.value = error instanceof Error ? error.message : String(error);
    }
  }

  /** Set the picture; the old bitmap is closed only after readers have the new one. */
  private replace(picture: Picture | null): void {
    const old = this.picture.peek();
    this.picture.value = picture;
    if (old !== null && "close" in old.image) old.image.close();
  }
}

/** Draw a picture into a canvas, which takes its size. */
export function drawPicture(canvas: HTMLCanvasElement, { image, width, height }: Picture): void {
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  context?.clearRect(0, 0, width, height);
  context?.drawImage(image, 0, 0);
}
