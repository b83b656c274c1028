import { describe, expect, it } from "vitest";

import { readPixels, type Normalization, type Pixels } from "../../src/displays/pictures/pixels";
import type { RawImage } from "../../src/displays/pictures/raw_image";

const AUTOMATIC: Normalization = { isAutomatic: true, min: 0, max: 1, window: 5 };

function image(
  encoding: string,
  width: number,
  height: number,
  data: Uint8Array,
  changes: Partial<RawImage> = {},
): RawImage {
  return { width, height, encoding, is_bigendian: 0, step: data.length / height, data, ...changes };
}

function pixels(read: Pixels | string): Pixels {
  if (typeof read === "string") throw new Error(read);
  return read;
}

function shown(of: RawImage, normalization = AUTOMATIC): number[] {
  return [...pixels(readPixels(of, normalization)).rgba];
}

describe("pixels of", () => {
  it.each([
    ["rgb8", [1, 2, 3], [1, 2, 3, 255]],
    ["bgr8", [1, 2, 3], [3, 2, 1, 255]],
    ["8UC3", [1, 2, 3], [3, 2, 1, 255]],
    ["rgba8", [1, 2, 3, 4], [1, 2, 3, 4]],
    ["bgra8", [1, 2, 3, 4], [3, 2, 1, 4]],
    ["mono8", [7], [7, 7, 7, 255]],
    ["8UC1", [7], [7, 7, 7, 255]],
    ["rgb16", [0, 1, 0, 2, 0, 3], [1, 2, 3, 255]],
  ])("%s", (encoding, bytes, rgba) => expect(shown(image(encoding, 1, 1, new Uint8Array(bytes)))).toEqual(rgba));

  it("rgb16 of a big-endian machine", () => {
    expect(shown(image("rgb16", 1, 1, new Uint8Array([1, 0, 2, 0, 3, 0]), { is_bigendian: 1 }))).toEqual([
      1, 2, 3, 255,
    ]);
  });

  it("rows that end in padding", () => {
    expect(shown(image("mono8", 1, 2, new Uint8Array([5, 99, 99, 6]), { step: 3 }))).toEqual([
      5, 5, 5, 255, 6, 6, 6, 255,
    ]);
  });

  it("16UC1 by its range, and by a fixed one", () => {
    const depth = image("16UC1", 3, 1, new Uint8Array(new Uint16Array([1000, 1500, 2000]).buffer));
    expect(shown(depth).filter((_, at) => at % 4 === 0)).toEqual([0, 127, 255]);
    expect(shown(depth, { isAutomatic: false, min: 0, max: 4000, window: 5 }).filter((_, at) => at % 4 === 0)).toEqual([
      63, 95, 127,
    ]);
  });

  it("32FC1 with NaN and infinities", () => {
    const depth = image("32FC1", 5, 1, new Uint8Array(new Float32Array([NaN, 1, 3, Infinity, -Infinity]).buffer));
    expect(shown(depth).filter((_, at) => at % 4 === 0)).toEqual([0, 0, 255, 255, 0]);
  });

  it("32FC1 without one number", () => {
    const depth = image("32FC1", 2, 1, new Uint8Array(new Float32Array([NaN, NaN]).buffer));
    expect(shown(depth)).toEqual([0, 0, 0, 255, 0, 0, 0, 255]);
  });

  it("numbers by the median of the last ranges", () => {
    const one = (max: number): RawImage => image("32FC1", 2, 1, new Uint8Array(new Float32Array([0, max]).buffer));
    const first = pixels(readPixels(one(10), AUTOMATIC));
    const second = pixels(readPixels(one(1000), AUTOMATIC, first.history));
    const third = pixels(readPixels(one(20), AUTOMATIC, second.history));
    expect(third.history.maxima).toEqual([20, 1000, 10]);
    expect(pixels(readPixels(one(10), AUTOMATIC, third.history)).rgba[4]).toBe(127); // of 20, the upper one in the middle
  });

  it.each([
    ["bayer_rggb8", [10, 20, 30, 40]],
    ["bayer_grbg8", [20, 10, 40, 30]],
    ["bayer_gbrg8", [20, 40, 10, 30]],
    ["bayer_bggr8", [40, 20, 30, 10]],
  ])("%s: red 10, greens 20 and 30, blue 40", (encoding, bytes) => {
    expect(shown(image(encoding, 2, 2, new Uint8Array(bytes))).slice(0, 4)).toEqual([10, 25, 40, 255]);
  });

  it("yuv422: grey without chroma, and red", () => {
    expect(shown(image("yuv422", 2, 1, new Uint8Array([128, 100, 128, 200])))).toEqual([
      100, 100, 100, 255, 200, 200, 200, 255,
    ]);
    const [red = 0, green = 0, blue = 0] = shown(image("yuv422", 2, 1, new Uint8Array([85, 76, 255, 76])));
    expect([red, green, blue].map((part) => Math.round(part / 10))).toEqual([25, 0, 0]);
  });
});

describe("an image is refused", () => {
  it.each([
    [
      "of a thousand millions of columns",
      image("rgb8", 1e9, 1, new Uint8Array(3)),
      /^Data size \(3 bytes\) does not match width \(1000000000\)/,
    ],
    [
      "whose product has 32 bits of zeros",
      image("mono8", 65536, 65536, new Uint8Array(0), { step: 65536 }),
      /^Data size \(0 bytes\)/,
    ],
    ["of a step less than a row", image("rgb8", 2, 1, new Uint8Array(6), { step: 5 }), /^Data size/],
    ["with its last row cut", image("mono8", 2, 2, new Uint8Array(3), { step: 2 }), /^Data size/],
    ["of no size", image("rgb8", 0, 0, new Uint8Array(0), { step: 0 }), "Image is zero-sized (0x0)"],
    [
      "of an encoding that rviz does not know",
      image("nv12", 1, 1, new Uint8Array(9)),
      "Unsupported image encoding [nv12]",
    ],
    [
      "whose encoding is a name of JavaScript",
      image("constructor", 1, 1, new Uint8Array(9)),
      "Unsupported image encoding [constructor]",
    ],
    [
      "of a mosaic that does not exist",
      image("bayer_rgrg8", 1, 1, new Uint8Array(9)),
      "Unsupported image encoding [bayer_rgrg8]",
    ],
  ])("%s", (_name, of, sentence) => {
    expect(readPixels(of, AUTOMATIC)).toEqual(
      typeof sentence === "string" ? sentence : expect.stringMatching(sentence),
    );
  });
});
