/** Shows an .rviz file with messages that a test hands over: `open(file, frames, parameters, messages)`. */

import "../../src/scene/conventions";
import "../../src/displays/all";

import { signal } from "@preact/signals";

import { DisplayStore } from "../../src/displays/display_store";
import { ThreeScene } from "../../src/scene/three_scene";
import { ViewList } from "../../src/scene/views/view_list";
import { AXIS_RGB } from "../../src/shapes/axes";
import { GraphNames } from "../../src/protocol/graph_names";
import { FakeFrames, FakeUndo } from "../displays/support";
import { FakeConnection } from "../fake_connection";
import { GhostShapes } from "../../src/scene/world/ghost_shapes";

interface Sent {
  readonly topic: string;
  readonly type: string;
  readonly message: unknown;
}

const host = document.getElementById("host");
if (host === null) throw new Error("no host");
const scene = new ThreeScene(host);
scene.grid.value = false;
const views = new ViewList(scene, () => null);
let store: DisplayStore | null = null;
let connection = new FakeConnection();
scene.onTick((elapsed) => store?.update(connection.now(), elapsed));

async function open(
  file: string,
  frames: Readonly<Record<string, readonly [number, number, number]>>,
  parameters: Readonly<Record<string, string>>,
  messages: readonly Sent[],
): Promise<readonly string[]> {
  connection = new FakeConnection();
  connection.time = BigInt(Date.now()) * 1_000_000n;
  for (const [name, value] of Object.entries(parameters)) connection.setParameter(name, value);
  for (const { topic, type } of messages) connection.advertise(topic, type);
  const tree = new FakeFrames();
  tree.set("map", null);
  for (const [name, position] of Object.entries(frames)) tree.set(name, "map", position);
  store?.load("Visualization Manager:\n  Displays: []\n");
  const tools = { save: () => [], load: () => [] };
  store = new DisplayStore({
    connection,
    names: new GraphNames(),
    frames: tree,
    scene,
    axisColors: signal(AXIS_RGB),
    ghostShapes: new GhostShapes(),
    undo: new FakeUndo(),
    views,
    tools,
  });
  const faults = store.load(file);
  scene.background.value = `rgb(${store.backgroundColor.value.value.join(",")})`;
  for (const { topic, message } of messages) connection.receive(topic, message);
  scene.invalidate();
  for (let frame = 0; frame < 4; frame++) await new Promise((resolve) => requestAnimationFrame(resolve));
  return [
    ...faults,
    ...store.displays.value.flatMap((display) =>
      [...display.statuses.value].map(([name, { level, text }]) => `${name}: ${level}: ${text}`),
    ),
  ];
}

Object.assign(window, { openRviz: open, scene });
