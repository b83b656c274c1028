// @vitest-environment jsdom
import { expect, it } from "vitest";

import { change, colorOf, hex, vectorOf } from "../../../src/app/displays/property_editor";
import { ColorProperty, NumberProperty } from "../../../src/rviz/properties";
import { fakePage } from "../../fake_page";

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

it("changes properties within their limits, undoably", () => {
  const page = fakePage();
  const alpha = new NumberProperty("Alpha", 0.5, { min: 0, max: 1 });
  const color = new ColorProperty("Color", [1, 2, 3]);
  change(page, alpha, 7);
  change(page, color, "9; 9; 9");
  expect([alpha.value.value, color.value.value, page.undo.undoTitle.value]).toEqual([1, [9, 9, 9], "Change of Color"]);
  page.undo.undo();
  page.undo.undo();
  expect([alpha.value.value, color.value.value]).toEqual([0.5, [1, 2, 3]]);
});
