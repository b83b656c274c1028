import { expect, test } from "vitest";

import { pixelValue } from "../../src/panels/images/pixel_value";
import type { Image } from "../../src/protocol/generated/ros_messages";

function image(encoding: string, width: number, height: number, step: number, data: Uint8Array, isBig = 0): Image {
  return {
    header: { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "" },
    width,
    height,
    encoding,
    is_bigendian: isBig,
    step,
    data,
  };
}

test("channels by name, numbers as they are", () => {
  const colors = image(
    "bgr8",
    2,
    2,
    8,
    Uint8Array.from({ length: 16 }, (_, index) => index),
  );
  expect(pixelValue(colors, 1, 1)).toEqual([
    ["b", 11],
    ["g", 12],
    ["r", 13],
  ]);
  const depth = image("32FC1", 2, 1, 8, new Uint8Array(new Float32Array([1.5, NaN]).buffer));
  expect(pixelValue(depth, 0, 0)).toEqual([["", 1.5]]);
  expect(pixelValue(image("16UC1", 1, 1, 2, Uint8Array.of(1, 2), 1), 0, 0)).toEqual([["", 258]]);
  expect(pixelValue(image("mono16", 1, 1, 2, Uint8Array.of(1, 2)), 0, 0)).toEqual([["", 513]]);
});

test("a pixel outside, or of a mosaic, has no value", () => {
  const small = image("mono8", 2, 1, 2, Uint8Array.of(1, 2));
  expect([
    pixelValue(small, 2, 0),
    pixelValue(small, 0, 1),
    pixelValue({ ...small, encoding: "bayer_rggb8" }, 0, 0),
  ]).toEqual([null, null, null]);
  expect(pixelValue({ ...small, encoding: "8UC99999999999" }, 0, 0)).toBeNull();
});
