/** The simulated world alone, fed by the test. */

import "../../src/scene/conventions";
import "../../src/theme/tokens.css";

import { signal } from "@preact/signals";

import { ThreeScene } from "../../src/scene/three_scene";
import { ViewList } from "../../src/scene/views/view_list";
import { SelectionOutline, type Outlined } from "../../src/scene/world/selection_outline";
import { WorldFeed } from "../../src/scene/world/world_feed";
import { NoTransform } from "../../src/frames/transform";
import { FakeConnection } from "../fake_connection";

const host = document.getElementById("host");
if (host === null) throw new Error("no host");
const connection = new FakeConnection();
const scene = new ThreeScene(host);
const frames = {
  frames: signal([]),
  describe: () => [],
  lookup: () => new NoTransform("", ""),
  drawnAt: null,
  moved: null,
  newestTime: () => 0n,
};
const world = new WorldFeed(connection, scene, frames, signal("world"));
const outlined = signal<readonly Outlined[]>([]);
new SelectionOutline(scene, world, () => outlined.value);
const views = new ViewList(scene, () => null);

Object.assign(window, {
  connection,
  scene,
  world,
  views,
  outlined,
  show: (manifest: unknown) =>
    connection.receiveRaw("trundle/world", new DataView(new TextEncoder().encode(JSON.stringify(manifest)).buffer)),
});
