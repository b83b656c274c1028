/** Images whose pixels share colors: Bayer mosaics and YUV 4:2:2. */

import type { RawImage } from "./raw_image";

/** Place of the red pixel in a cell of 2 × 2. */
const RED: Readonly<Record<string, readonly [x: number, y: number]>> = {
  bayer_rggb: [0, 0],
  bayer_grbg: [1, 0],
  bayer_gbrg: [0, 1],
  bayer_bggr: [1, 1],
};

export function isBayer(encoding: string): boolean {
  return /^bayer_(rggb|grbg|gbrg|bggr)(8|16)$/.test(encoding);
}

/** Each cell of 2 × 2 in one color: its red, its blue and the mean of its greens. rviz shows the mosaic in grey. */
export function demosaic(
  { width, height, encoding, step, data, is_bigendian }: RawImage,
  rgba: Uint8ClampedArray,
): void {
  const bytes = encoding.endsWith("16") ? 2 : 1;
  const high = bytes === 2 && is_bigendian === 0 ? 1 : 0;
  const [redX, redY] = RED[encoding.slice(0, 10)] ?? [0, 0];
  const at = (x: number, y: number): number =>
    data[Math.min(y, height - 1) * step + Math.min(x, width - 1) * bytes + high] ?? 0;
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const [cellX, cellY] = [x & ~1, y & ~1];
      const to = (y * width + x) * 4;
      rgba[to] = at(cellX + redX, cellY + redY);
      rgba[to + 1] = (at(cellX + 1 - redX, cellY + redY) + at(cellX + redX, cellY + 1 - redY)) / 2;
      rgba[to + 2] = at(cellX + 1 - redX, cellY + 1 - redY);
      rgba[to + 3] = 255;
    }
  }
}

/** Pairs of pixels with common chroma: UYVY, or YUYV where luma comes first (0). Coefficients of BT.601. */
export function unpackYuv({ width, height, step, data }: RawImage, luma: 0 | 1, rgba: Uint8ClampedArray): void {
  for (let y = 0, to = 0; y < height; y++) {
    for (let x = 0; x < width; x++, to += 4) {
      const pair = y * step + (x & ~1) * 2;
      const grey = data[pair + luma + 2 * (x & 1)] ?? 0;
      const u = (data[pair + 1 - luma] ?? 128) - 128;
      const v = (data[pair + 3 - luma] ?? 128) - 128;
      rgba[to] = grey + 1.402 * v;
      rgba[to + 1] = grey - 0.344136 * u - 0.714136 * v;
      rgba[to + 2] = grey + 1.772 * u;
      rgba[to + 3] = 255;
    }
  }
}
