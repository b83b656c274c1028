/** Pictures of image messages as bitmaps: raw ones by the worker, compressed ones by the browser. */

import type { CompressedImage, Image } from "../../protocol/generated/ros_messages";
import type { PictureAnswer, PictureRequest } from "./picture_worker";
import type { Normalization, RangeHistory } from "./pixels";

export interface Decoded {
  readonly bitmap: ImageBitmap;
  readonly history: RangeHistory;
}

/** Decodes an image; rejects with a sentence. */
export type DecodePicture = (
  message: Image | CompressedImage,
  normalization: Normalization,
  history: RangeHistory,
) => Promise<Decoded>;

let worker: Worker | null = null;
let count = 0;
const waiting = new Map<number, { resolve: (decoded: Decoded) => void; reject: (fault: Error) => void }>();

export const decodePicture: DecodePicture = (message, normalization, history) =>
  "format" in message ? decompress(message, history) : unpack(message, normalization, history);

function unpack(message: Image, normalization: Normalization, history: RangeHistory): Promise<Decoded> {
  const id = count++;
  const { width, height, encoding, is_bigendian, step } = message;
  const data = message.data.slice(); // a copy: the message's other readers need its bytes
  const request: PictureRequest = {
    id,
    image: { width, height, encoding, is_bigendian, step, data },
    normalization,
    history,
  };
  return new Promise((resolve, reject) => {
    waiting.set(id, { resolve, reject });
    theWorker().postMessage(request, [data.buffer]);
  });
}

function theWorker(): Worker {
  if (worker !== null) return worker;
  worker = new Worker(new URL("./picture_worker.ts", import.meta.url), { type: "module" });
  worker.onmessage = ({ data }: MessageEvent<PictureAnswer>) => {
    const request = waiting.get(data.id);
    waiting.delete(data.id);
    if ("fault" in data) request?.reject(new Error(data.fault));
    else request?.resolve(data);
  };
  return worker;
}

async function decompress({ format, data }: CompressedImage, history: RangeHistory): Promise<Decoded> {
  const kind = /png|jpe?g|webp/i.exec(format)?.[0].toLowerCase();
  if (kind === undefined || format.includes("compressedDepth")) throw new Error(`Unsupported image format [${format}]`);
  const type = kind === "png" || kind === "webp" ? `image/${kind}` : "image/jpeg";
  try {
    return { bitmap: await createImageBitmap(new Blob([data.slice()], { type })), history };
  } catch {
    throw new Error(`${data.length} bytes are no picture of format [${format}]`);
  }
}
