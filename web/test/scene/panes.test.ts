// @vitest-environment jsdom
import { signal } from "@preact/signals";
import { expect, test } from "vitest";

import { LabelSet } from "../../src/scene/label_layer";
import { paneAreas } from "../../src/scene/panes/pane_layout";
import { ScenePanes } from "../../src/scene/panes/scene_panes";

const SIZE = { width: 1000, height: 600 };
const INSETS = { left: 300, right: 100, top: 10, bottom: 190 };

function setUp() {
  return new ScenePanes(document.createElement("div"), new LabelSet(() => undefined), signal(SIZE), signal(INSETS));
}

test("one pane is the whole scene", () => {
  expect(paneAreas("one", SIZE, INSETS, 40)).toEqual([{ area: { left: 0, top: 0, ...SIZE }, insets: INSETS }]);
});

test("the free part is halved, and panels cover the panes next to them", () => {
  const [right, left, bottom, corner] = paneAreas("four", SIZE, INSETS, 40);
  expect(left).toEqual({
    area: { left: 0, top: 0, width: 600, height: 210 },
    insets: { left: 300, right: 0, top: 50, bottom: 0 },
  });
  expect(right).toEqual({
    area: { left: 600, top: 0, width: 400, height: 210 },
    insets: { left: 0, right: 100, top: 50, bottom: 0 },
  });
  expect(bottom).toEqual({
    area: { left: 0, top: 210, width: 600, height: 390 },
    insets: { left: 300, right: 0, top: 0, bottom: 190 },
  });
  expect(corner).toEqual({
    area: { left: 600, top: 210, width: 400, height: 390 },
    insets: { left: 0, right: 100, top: 0, bottom: 190 },
  });
});

test("a pressed pane becomes active, and has the pointer until the button goes up", () => {
  const panes = setUp();
  panes.layout.value = "beside";
  const [left, right] = panes.shown.value;
  expect(panes.at(599, 5)).toBe(left);
  expect(panes.press(601, 5)).toBe(right);
  expect(panes.point(20, 5)).toBe(right);
  panes.release();
  expect(panes.point(20, 5)).toBe(left);
  expect(panes.active.value).toBe(right);
});
