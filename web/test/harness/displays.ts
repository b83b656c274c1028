/** Shows one display at a time with messages that a test hands over: `show(className, yaml, topics)`. */

import "../../src/scene/conventions";
import "../../src/displays/all";

import { signal } from "@preact/signals";
import { Quaternion, Vector3 } from "three";

import type { Display, DisplayContext } from "../../src/displays/display";
import type { YamlMapping } from "../../src/rviz/properties";
import { drawPicture, type PictureSource } from "../../src/displays/pictures/picture_stream";
import { displayClass } from "../../src/displays/registry";
import { AXIS_RGB, Axes } from "../../src/shapes/axes";
import type { Transform } from "../../src/frames/transform";
import { ThreeScene } from "../../src/scene/three_scene";
import { GraphNames } from "../../src/protocol/graph_names";
import { FakeConnection } from "../fake_connection";
import { makeMessage } from "./messages";
import { GhostShapes } from "../../src/scene/world/ghost_shapes";

const host = document.getElementById("host");
if (host === null) throw new Error("no host");
const scene = new ThreeScene(host);
scene.background.value = "#303030";
scene.grid.value = false;
const camera = scene.camera.peek();
camera.near = 0.05;

const TILTED = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), Math.PI / 6);
/** z forward along the map's x. */
const OPTICAL = new Quaternion(-0.5, 0.5, -0.5, 0.5);
const POSES: Readonly<Record<string, Transform>> = {
  tilted: { position: new Vector3(0, 0, 1), orientation: TILTED },
  optical: { position: new Vector3(-3, 0, 0.5), orientation: OPTICAL },
};

/** Frames that are not in `POSES` stand at the origin. */
const frames = {
  frames: signal([]),
  describe: () => [],
  lookup: (_target: string, source: string): Transform =>
    POSES[source] ?? { position: new Vector3(), orientation: new Quaternion() },
};

/** What camera displays show over their pictures. */
const axes = new Axes(1, 0.1);
scene.displays.add(axes);
const canvas = document.createElement("canvas");
canvas.className = "picture";

/** Show the picture of a display that has one. */
function showPicture(): void {
  const source = display as Partial<PictureSource> | null;
  const picture = source?.picture?.peek() ?? null;
  if (picture === null) canvas.remove();
  else {
    drawPicture(canvas, picture);
    document.body.append(canvas);
  }
}

let display: Display | null = null;
let connection = new FakeConnection();
scene.onTick((elapsed) => {
  display?.update(connection.now(), elapsed);
  showPicture();
});

interface Sent {
  readonly topic: string;
  readonly type: string;
  readonly message: string;
}

function show(
  className: string,
  yaml: YamlMapping,
  sent: readonly Sent[],
  from: readonly [number, number, number],
  to: readonly [number, number, number],
): Promise<string> {
  display?.stop();
  axes.visible = className === "rviz/Camera";
  camera.position.set(...from);
  camera.lookAt(...to);
  connection = new FakeConnection();
  const context: DisplayContext = {
    connection,
    names: new GraphNames(),
    frames: frames,
    scene,
    displays: signal([]),
    fixedFrame: signal("map"),
    axisColors: signal(AXIS_RGB),
    ghostShapes: new GhostShapes(),
  };
  display = displayClass(className)?.create(context) ?? null;
  if (display === null) throw new Error(`no ${className}`);
  for (const { topic, type } of sent) connection.advertise(topic, type);
  const faults = display.load({ Enabled: true, ...yaml });
  display.start();
  for (const { topic, message } of sent) connection.receive(topic, makeMessage(message));
  scene.invalidate();
  return frame()
    .then(frame)
    .then(() =>
      [
        ...faults,
        ...[...(display?.statuses.value ?? [])].map(([name, { level, text }]) => `${name}: ${level}: ${text}`),
      ].join("\n"),
    );
}

function frame(): Promise<void> {
  return new Promise((resolve) => requestAnimationFrame(() => resolve()));
}

/** Milliseconds from a message's arrival until its points are handed to WebGL, and to the end of the next frame. */
async function measure(
  className: string,
  yaml: YamlMapping,
  sent: Sent,
  times: number,
): Promise<{ update: number[]; frame: number[] }> {
  await show(className, yaml, [sent], [-3, -3, 3], [0, 0, 0]);
  const update: number[] = [];
  const wholeFrame: number[] = [];
  for (let count = 0; count < times; count++) {
    const message = makeMessage(sent.message);
    const begin = performance.now();
    connection.receive(sent.topic, message);
    display?.update(0n, 0.01);
    update.push(performance.now() - begin);
    await frame();
    await frame();
    wholeFrame.push(performance.now() - begin);
  }
  return { update, frame: wholeFrame };
}

Object.assign(window, { show, measure, scene, frame });
