/** Pixels of sensor_msgs/Image as RGBA, as rviz shows them; runs in a worker. */

import { demosaic, isBayer, unpackYuv } from "./mosaics";
import type { RawImage } from "./raw_image";

/** Conversion of numbers to grey: by the image's range, the median of the last ranges, or a fixed range. */
export interface Normalization {
  readonly isAutomatic: boolean;
  readonly min: number;
  readonly max: number;
  readonly window: number;
}

/** Ranges of the last images, newest first. */
export interface RangeHistory {
  readonly minima: readonly number[];
  readonly maxima: readonly number[];
}

export const NO_HISTORY: RangeHistory = { minima: [], maxima: [] };

export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly rgba: Uint8ClampedArray<ArrayBuffer>;
  readonly history: RangeHistory;
}

/** Most pixels of an image; a browser's canvas holds no more. */
const MAX_PIXELS = 16384 * 16384;

/** Bytes of a pixel and the places of red, green, blue and alpha in it. */
type Layout = readonly [bytes: number, red: number, green: number, blue: number, alpha: number | null];
const LAYOUTS = new Map<string, Layout>([
  ["rgb8", [3, 0, 1, 2, null]],
  ["rgba8", [4, 0, 1, 2, 3]],
  ["bgr8", [3, 2, 1, 0, null]],
  ["bgra8", [4, 2, 1, 0, 3]],
  ["8UC3", [3, 2, 1, 0, null]],
  ["8SC3", [3, 2, 1, 0, null]],
  ["8UC4", [4, 2, 1, 0, 3]],
  ["8SC4", [4, 2, 1, 0, 3]],
  ["mono8", [1, 0, 0, 0, null]],
  ["8UC1", [1, 0, 0, 0, null]],
  ["8SC1", [1, 0, 0, 0, null]],
  // offset of each component's more significant byte in a little-endian image
  ["rgb16", [6, 1, 3, 5, null]],
  ["rgba16", [8, 1, 3, 5, 7]],
  ["bgr16", [6, 5, 3, 1, null]],
  ["bgra16", [8, 5, 3, 1, 7]],
]);

/** Encodings of one number for a pixel, with the bytes that it takes. */
const NUMBERS = new Map([
  ["mono16", 2],
  ["16UC1", 2],
  ["16SC1", 2],
  ["32FC1", 4],
]);

export function isNumeric(encoding: string): boolean {
  return NUMBERS.has(encoding);
}

/** Pixels of an image, or an error. */
export function readPixels(
  image: RawImage,
  normalization: Normalization,
  history: RangeHistory = NO_HISTORY,
): Pixels | string {
  const { width, height, encoding } = image;
  if (width === 0 || height === 0) return `Image is zero-sized (${width}x${height})`;
  const bytes = bytesPerPixel(encoding);
  if (bytes === null) return `Unsupported image encoding [${encoding}]`;
  const needed = (height - 1) * image.step + width * bytes;
  if (image.step < width * bytes || needed > image.data.length || width * height > MAX_PIXELS) {
    return `Data size (${image.data.length} bytes) does not match width (${width}), height (${height}) and step (${image.step}) of ${encoding}`;
  }
  const rgba = new Uint8ClampedArray(width * height * 4);
  const layout = LAYOUTS.get(encoding);
  let next = history;
  if (layout !== undefined) unpack(image, layout, rgba);
  else if (isNumeric(encoding)) next = spread(image, normalization, history, rgba);
  else if (isBayer(encoding)) demosaic(image, rgba);
  else unpackYuv(image, encoding === "yuv422_yuy2" ? 0 : 1, rgba);
  return { width, height, rgba, history: next };
}

function bytesPerPixel(encoding: string): number | null {
  const layout = LAYOUTS.get(encoding);
  if (layout !== undefined) return layout[0];
  if (isBayer(encoding)) return encoding.endsWith("16") ? 2 : 1;
  if (encoding === "yuv422" || encoding === "yuv422_yuy2") return 2;
  return NUMBERS.get(encoding) ?? null;
}

function unpack({ width, height, step, data, is_bigendian }: RawImage, layout: Layout, rgba: Uint8ClampedArray): void {
  const [bytes, red, green, blue, alpha] = layout;
  const earlier = bytes > 4 && is_bigendian !== 0 ? 1 : 0; // the more significant byte comes first
  for (let y = 0, to = 0; y < height; y++) {
    for (let x = 0, from = y * step - earlier; x < width; x++, from += bytes, to += 4) {
      rgba[to] = data[from + red] ?? 0;
      rgba[to + 1] = data[from + green] ?? 0;
      rgba[to + 2] = data[from + blue] ?? 0;
      rgba[to + 3] = alpha === null ? 255 : (data[from + alpha] ?? 255);
    }
  }
}

/** Grey by each pixel's number; returns the ranges that the next image's median is taken from. */
function spread(
  image: RawImage,
  normalization: Normalization,
  history: RangeHistory,
  rgba: Uint8ClampedArray,
): RangeHistory {
  const numbers = readNumbers(image);
  let { min, max } = normalization;
  let next = history;
  if (normalization.isAutomatic) {
    [min, max] = finiteRange(numbers);
    const window = Math.max(1, normalization.window);
    next = { minima: [min, ...history.minima].slice(0, window), maxima: [max, ...history.maxima].slice(0, window) };
    min = median(next.minima);
    max = median(next.maxima);
  }
  const range = max - min;
  for (let index = 0, to = 0; index < numbers.length; index++, to += 4) {
    const share = range > 0 ? ((numbers[index] ?? 0) - min) / range : 0;
    const grey = Math.trunc(255 * Math.min(1, Math.max(0, share))) || 0; // NaN is black
    rgba[to] = rgba[to + 1] = rgba[to + 2] = grey;
    rgba[to + 3] = 255;
  }
  return next;
}

/** Numbers of the pixels of 16-bit and float images, by rows; as rviz, 16SC1 without its sign. */
export function readNumbers({ width, height, encoding, step, data, is_bigendian }: RawImage): Float64Array {
  const numbers = new Float64Array(width * height);
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const isLittle = is_bigendian === 0;
  const isFloat = encoding === "32FC1";
  for (let y = 0, index = 0; y < height; y++) {
    for (let x = 0; x < width; x++, index++) {
      const at = y * step + x * (isFloat ? 4 : 2);
      numbers[index] = isFloat ? view.getFloat32(at, isLittle) : view.getUint16(at, isLittle);
    }
  }
  return numbers;
}

function finiteRange(numbers: Float64Array): [number, number] {
  let min = Infinity;
  let max = -Infinity;
  for (const number of numbers) {
    if (number < min && number > -Infinity) min = number;
    if (number > max && number < Infinity) max = number;
  }
  return min <= max ? [min, max] : [0, 0];
}

/** rviz's median: the upper of the two in the middle. */
function median(values: readonly number[]): number {
  return [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? 0;
}
