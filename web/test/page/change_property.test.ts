// @vitest-environment jsdom
import { expect, it } from "vitest";

import { changeProperty } from "../../src/page/change_property";
import { ColorProperty, NumberProperty } from "../../src/rviz/properties";
import { fakePage } from "../fake_page";

it("changes properties within their limits, undoably", () => {
  const page = fakePage();
  const alpha = new NumberProperty("Alpha", 0.5, { min: 0, max: 1 });
  const color = new ColorProperty("Color", [1, 2, 3]);
  changeProperty(page, alpha, 7);
  changeProperty(page, color, "9; 9; 9");
  expect([alpha.value.value, color.value.value, page.undo.undoTitle.value]).toEqual([1, [9, 9, 9], "Change of Color"]);
  page.undo.undo();
  page.undo.undo();
  expect([alpha.value.value, color.value.value]).toEqual([0.5, [1, 2, 3]]);
});
