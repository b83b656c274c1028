import { signal } from "@preact/signals";
import { expect, test } from "vitest";

import { linkedView, linkTo, shareableOrigins, showLinkedView } from "../../../src/app/views/view_link";
import type { PaneLayout } from "../../../src/scene/panes/pane_layout";
import { Orbit } from "../../../src/scene/views/orbit";
import { fakePane, FakeViews } from "../../fake_views";

test("a link restores its view", () => {
  const view = new Orbit();
  view.load({
    Distance: 3.25,
    "Focal Point": { X: 1, Y: -2, Z: 0.5 },
    Yaw: 1.2345678,
    Pitch: 0.4,
    "Target Frame": "cart::chassis",
  });
  const link = linkTo(
    Object.assign(new FakeViews(), { current: signal(view) }),
    "http://127.0.0.1:8080/?view_only#view=old",
    "abc",
  );
  const linked = linkedView(new URL(link).hash);

  expect(link).toMatch(/^http:\/\/127\.0\.0\.1:8080\/\?token=abc#view=[^#]*$/);
  const shown = new Orbit();
  expect(shown.load(linked ?? {})).toEqual([]);
  expect(shown.save()).toMatchObject({
    Distance: 3.25,
    "Focal Point": { X: 1, Y: -2, Z: 0.5 },
    Yaw: 1.23457,
    "Target Frame": "cart::chassis",
  });
});

test.each(["", "#elsewhere", "#view=", "#view=%7B", "#view=%", "#view=3", "#view=null"])("%s is not a view", (hash) => {
  expect(linkedView(hash)).toBeNull();
});

test("a link that is too long is not read", () => {
  expect(linkedView(`#view={"Yaw":1${" ".repeat(9000)}}`)).toBeNull();
});

test("a link of several panes restores each one's view", () => {
  const [first, second] = [new Orbit(), new Orbit()];
  second.distance.value.value = 7;
  const from = new FakeViews();
  from.layout.value = "beside";
  from.panes.value = [fakePane(signal(first)), fakePane(signal(second))];
  const [, pane] = from.panes.value;
  if (pane !== undefined) from.activate(pane);
  const linked = linkedView(new URL(linkTo(from, "http://127.0.0.1/", "abc")).hash);

  const shown = [new Orbit(), new Orbit()];
  const split = signal<PaneLayout>("one");
  const views = Object.assign(new FakeViews(), { panes: signal(shown.map((view) => fakePane(signal(view)))) });
  showLinkedView(views, split, linked ?? {});
  expect(split.value).toBe("beside");
  expect(shown.map((view) => view.distance.value.value)).toEqual([10, 7]);
  expect(views.active.value).toBe(views.panes.value[1]);
});

const NETWORK = ["http://192.168.7.1:8080", "http://10.0.0.3:8080"];

test.each([
  ["localhost", NETWORK, NETWORK],
  ["127.0.0.1", NETWORK, NETWORK],
  ["[::1]", NETWORK, NETWORK],
  ["localhost", [], []],
  ["192.168.7.1", NETWORK, NETWORK],
  ["robot.example", NETWORK, ["http://robot.example:8080", ...NETWORK]],
])("a browser at %s shares the addresses that other devices reach", (hostname, urls, expected) => {
  expect(shareableOrigins({ hostname, origin: `http://${hostname}:8080` }, urls)).toEqual(expected);
});
