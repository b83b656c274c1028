import "../../src/theme/tokens.css";
import "../../src/scene/conventions";

import {
  AxesHelper,
  Box3,
  BoxGeometry,
  BufferGeometry,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Points,
  PointsMaterial,
  Vector3,
} from "three";

import { signal } from "@preact/signals";

import type { Selection } from "../../src/page/page";
import { SceneInput } from "../../src/scene/pointer_input";
import { ThreeScene } from "../../src/scene/three_scene";
import { ViewList } from "../../src/scene/views/view_list";
import { ToolList } from "../../src/tools/tool_list";
import { GraphNames } from "../../src/protocol/graph_names";
import { GoalQueue } from "../../src/page/goal_queue";
import { FakeConnection } from "../fake_connection";

const host = document.getElementById("host");
if (host === null) throw new Error("no host");
const scene = new ThreeScene(host);
const views = new ViewList(scene, () => null);
const connection = new FakeConnection();
const selection = signal<Selection | null>(null);
const tools = new ToolList({
  connection,
  names: new GraphNames(),
  scene,
  views,
  fixedFrame: signal("map"),
  selection,
  select: (picked) => (selection.value = picked),
  hovered: signal(null),
  goals: new GoalQueue(),
  editor: null,
  viewOnly: false,
});
const input = new SceneInput(scene, views, (event) => tools.pointer(event));
scene.grid.value = true;

const flat = new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial({ color: "#4080c0" }));
flat.position.set(0, 0, 0.5);
const lit = new Mesh(new BoxGeometry(1, 1, 1), new MeshLambertMaterial({ color: "#c08040" }));
lit.position.set(2, 1, 0.5);
const line = new Line(
  new BufferGeometry().setFromPoints([new Vector3(-2, -2, 0.2), new Vector3(2, -2, 0.2)]),
  new LineBasicMaterial({ color: "#00ff00" }),
);
const cloud = Array.from({ length: 200 }, (_, i) => new Vector3(Math.cos(i / 10), Math.sin(i / 10), 1 + i / 100));
const points = new Points(
  new BufferGeometry().setFromPoints(cloud),
  new PointsMaterial({ color: "#ff6b4a", size: 4, sizeAttenuation: false }),
);
flat.name = "Marker";
flat.userData["selectable"] = { describe: () => ({ Namespace: "boxes" }) };
scene.displays.add(flat, lit, line, points);
for (let i = 0; i < 12; i += 1) {
  const axes = new AxesHelper(0.4);
  axes.position.set(-1 + (i % 4) * 0.5, -1.5 + Math.floor(i / 4) * 0.4, 0.3 + 0.1 * i);
  scene.displays.add(axes);
  scene.addLabel(axes, `frame_${i}`).detail = "in base_link";
}

Object.assign(window, { scene, views, tools, input, connection, selection, Box3, Vector3 });
