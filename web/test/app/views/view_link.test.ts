import { signal } from "@preact/signals";
import { expect, test } from "vitest";

import { linkedView, linkTo } from "../../../src/app/views/view_link";
import { Orbit } from "../../../src/scene/views/orbit";

test("a link shows the view from which it was made", () => {
  const view = new Orbit();
  view.load({ Distance: 3.25, "Focal Point": { X: 1, Y: -2, Z: 0.5 }, Yaw: 1.2345678, Pitch: 0.4, "Target Frame": "cart::chassis" });
  const link = linkTo({ current: signal(view) }, "http://127.0.0.1:8080/?token=abc#view=old");
  const found = linkedView(new URL(link).hash);

  expect(link).toMatch(/^http:\/\/127\.0\.0\.1:8080\/\?token=abc#view=[^#]*$/);
  const shown = new Orbit();
  expect(shown.load(found ?? {})).toEqual([]);
  expect(shown.save()).toMatchObject({ Distance: 3.25, "Focal Point": { X: 1, Y: -2, Z: 0.5 }, Yaw: 1.23457, "Target Frame": "cart::chassis" });
});

test.each(["", "#elsewhere", "#view=", "#view=%7B", "#view=%", "#view=3", "#view=null"])("%s is no view", (hash) => {
  expect(linkedView(hash)).toBeNull();
});

test("a link that is too long is not read", () => {
  expect(linkedView(`#view={"Yaw":1${" ".repeat(5000)}}`)).toBeNull();
});
