// @vitest-environment jsdom
import { expect, it } from "vitest";

import { colorOf, hex, vectorOf } from "../../../src/app/displays/property_editor";

it("reads vectors and colors as people write them", () => {
  expect([vectorOf("0; 1; −2.5"), vectorOf("0 1 2"), vectorOf("0; 1"), vectorOf("a;b;c")]).toEqual([
    [0, 1, -2.5],
    [0, 1, 2],
    null,
    null,
  ]);
  expect([
    colorOf("255; 25; 0"),
    colorOf("255,25,0"),
    colorOf("#ff1900"),
    colorOf("256; 0; 0"),
    colorOf("red"),
  ]).toEqual(["255; 25; 0", "255; 25; 0", "255; 25; 0", null, null]);
  expect(hex([255, 25, 0])).toBe("#ff1900");
});
