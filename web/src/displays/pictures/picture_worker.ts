/** Worker that turns images into bitmaps, so that no picture holds the page up. */

import { readPixels, type Normalization, type RangeHistory } from "./pixels";
import type { RawImage } from "./raw_image";

export interface PictureRequest {
  readonly id: number;
  readonly image: RawImage;
  readonly normalization: Normalization;
  readonly history: RangeHistory;
}

export type PictureAnswer =
  | { readonly id: number; readonly fault: string }
  | { readonly id: number; readonly bitmap: ImageBitmap; readonly history: RangeHistory };

async function answer({ id, image, normalization, history }: PictureRequest): Promise<void> {
  const pixels = readPixels(image, normalization, history);
  if (typeof pixels === "string") {
    postMessage({ id, fault: pixels } satisfies PictureAnswer);
    return;
  }
  const bitmap = await createImageBitmap(new ImageData(pixels.rgba, pixels.width, pixels.height), {
    premultiplyAlpha: "none",
  });
  postMessage({ id, bitmap, history: pixels.history } satisfies PictureAnswer, { transfer: [bitmap] });
}

addEventListener("message", ({ data }: MessageEvent<PictureRequest>) => {
  answer(data).catch((error: unknown) => postMessage({ id: data.id, fault: String(error) } satisfies PictureAnswer));
});
