// @vitest-environment jsdom
import "../../src/scene/conventions";

import { Box3, InstancedMesh, Matrix4, Mesh, Vector3, type Object3D } from "three";
import { describe, expect, it } from "vitest";

import { MarkerArrayDisplay, MarkerDisplay } from "../../src/displays/marker";
import { checkMarker } from "../../src/displays/markers/marker_checks";
import { Type } from "../../src/displays/markers/marker_type";
import { BillboardLines } from "../../src/shapes/billboard_lines";
import { BillboardPoints } from "../../src/shapes/billboard_points";
import { TextBillboard } from "../../src/shapes/text_billboard";
import type { Marker, Point } from "../../src/protocol/generated/ros_messages";
import { setup, type Setup } from "./support";

const ORIGIN = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };

function point(x: number, y: number, z = 0): Point {
  return { x, y, z };
}

function marker(fields: Partial<Marker> = {}): Marker {
  return {
    header: { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "base" },
    ns: "ns",
    id: 0,
    type: Type.cube,
    action: 0,
    pose: ORIGIN,
    scale: { x: 1, y: 1, z: 1 },
    color: { r: 1, g: 0.5, b: 0, a: 1 },
    lifetime: { sec: 0, nsec: 0 },
    frame_locked: false,
    points: [],
    colors: [],
    text: "",
    mesh_resource: "",
    mesh_use_embedded_materials: false,
    ...fields,
  };
}

interface Started extends Setup {
  readonly display: MarkerDisplay;
  readonly send: (...markers: readonly Partial<Marker>[]) => void;
  readonly boxes: () => Box3;
  readonly count: () => number;
}

function started(properties: Record<string, unknown> = {}): Started {
  const base = setup();
  base.frames.set("base", "map", [1, 0, 0]);
  const display = new MarkerDisplay(base.context);
  display.load({ "Marker Topic": "/markers", ...properties });
  display.start();
  return {
    ...base,
    display,
    send: (...markers) => {
      for (const fields of markers) base.connection.receive("/markers", marker(fields));
      display.update(base.connection.time, 0.01);
    },
    boxes: () => {
      display.root.updateMatrixWorld(true);
      return new Box3().setFromObject(display.root);
    },
    count: () => parts(display.root).reduce((sum, mesh) => sum + (mesh instanceof InstancedMesh ? mesh.count : 1), 0),
  };
}

function parts(root: Object3D): Mesh[] {
  const meshes: Mesh[] = [];
  root.traverseVisible((part) => {
    if (part instanceof Mesh) meshes.push(part as Mesh);
  });
  return meshes;
}

function extent(box: Box3): number[] {
  return [...box.min.toArray(), ...box.max.toArray()].map((part) => Number(part.toFixed(3)));
}

describe("solid markers", () => {
  it.each([
    ["a cube", { type: Type.cube, scale: { x: 2, y: 1, z: 0.5 } }, [0, -0.5, -0.25, 2, 0.5, 0.25]],
    ["a sphere", { type: Type.sphere, scale: { x: 2, y: 2, z: 1 } }, [0, -1, -0.5, 2, 1, 0.5]],
    ["a cylinder", { type: Type.cylinder, scale: { x: 1, y: 1, z: 3 } }, [0.5, -0.5, -1.5, 1.5, 0.5, 1.5]],
    ["an arrow by its scale", { type: Type.arrow, scale: { x: 2, y: 0.1, z: 0.1 } }, [1, -0.1, -0.1, 3, 0.1, 0.1]],
    [
      "an arrow between points",
      { type: Type.arrow, scale: { x: 0.1, y: 0.2, z: 0.3 }, points: [point(0, 0), point(2, 0)] },
      [1, -0.1, -0.1, 3, 0.1, 0.1],
    ],
    [
      "a list of cubes",
      { type: Type.cubeList, scale: { x: 1, y: 1, z: 1 }, points: [point(0, 0), point(0, 2)] },
      [0.5, -0.5, -0.5, 1.5, 2.5, 0.5],
    ],
    [
      "a list of spheres",
      { type: Type.sphereList, scale: { x: 1, y: 1, z: 1 }, points: [point(0, 0), point(2, 0)] },
      [0.5, -0.5, -0.5, 3.5, 0.5, 0.5],
    ],
  ])("%s has its size at its place", (_, fields, expected) => {
    const { send, boxes } = started();
    send(fields);
    expect(extent(boxes())).toEqual(expected);
  });

  it("are drawn together, however many they are", () => {
    const { send, display, count } = started();
    send(...Array.from({ length: 3000 }, (_, id) => ({ id, pose: { ...ORIGIN, position: point(id, 0) } })));
    expect(count()).toBe(3000);
    expect(parts(display.root)).toHaveLength(1);
  });

  it("that are transparent are blended apart from the others", () => {
    const { send, display } = started();
    send({ id: 1 }, { id: 2, color: { r: 1, g: 0, b: 0, a: 0.3 } });
    const blended = parts(display.root).map((mesh) => (mesh.material as { transparent: boolean }).transparent);
    expect(blended.sort()).toEqual([false, true]);
  });

  it("describe the picked one", () => {
    const { send, display } = started();
    send({ id: 4 }, { id: 5, ns: "other" });
    const selectable = parts(display.root)[0]?.userData["selectable"] as {
      describe(index: number): Record<string, unknown>;
    };
    expect(selectable.describe(1)).toMatchObject({ Marker: "other/5", Type: "CUBE", Frame: "base" });
  });
});

describe("other markers", () => {
  it("draw a strip of lines joined, a list in pairs, with colors by point", () => {
    const { send, display } = started();
    const points = [point(0, 0), point(1, 0), point(1, 1), point(0, 1)];
    const colors = points.map((_, index) => ({ r: index / 3, g: 0, b: 0, a: 1 }));
    send(
      { id: 1, type: Type.lineStrip, points, colors, scale: { x: 0.05, y: 0, z: 0 } },
      { id: 2, type: Type.lineList, points, scale: { x: 0.1, y: 0, z: 0 } },
    );
    const lines = parts(display.root).filter((part) => part instanceof BillboardLines);
    expect(lines.map((line) => [line.segments, line.width])).toEqual([
      [3, 0.05],
      [2, 0.1],
    ]);
    expect(lines[0]?.geometry.getAttribute("endRgba").getX(2)).toBeCloseTo(1);
  });

  it("draw points as squares", () => {
    const { send, display } = started();
    send({ type: Type.points, points: [point(0, 0), point(1, 0)], scale: { x: 0.1, y: 0.2, z: 0 } });
    const [points] = parts(display.root).filter((part) => part instanceof BillboardPoints);
    expect(points?.geometry.instanceCount).toBe(2);
  });

  it("draw a text at its height", () => {
    const { send, display } = started();
    send({ type: Type.text, text: "two\nlines", scale: { x: 0, y: 0, z: 0.4 } });
    const texts: TextBillboard[] = [];
    display.root.traverse((part) => part instanceof TextBillboard && texts.push(part));
    expect(texts[0]?.scale.y).toBeCloseTo(0.81); // two lines and rviz's gap
    expect(texts[0]?.position.x).toBe(1);
  });

  it("draw triangles, scaled, with a color per triangle", () => {
    const { send, display, boxes } = started();
    const points = [point(0, 0), point(1, 0), point(0, 1), point(0, 0, 1), point(1, 0, 1), point(0, 1, 1)];
    const colors = [
      { r: 1, g: 0, b: 0, a: 1 },
      { r: 0, g: 1, b: 0, a: 1 },
    ];
    send({ type: Type.triangleList, points, colors, scale: { x: 2, y: 2, z: 2 } });
    expect(extent(boxes())).toEqual([1, 0, 0, 3, 2, 2]);
    const color = parts(display.root)
      .find((part) => !(part instanceof InstancedMesh))
      ?.geometry.getAttribute("vertexRgba");
    expect([color?.getX(2), color?.getX(3), color?.getY(3)]).toEqual([1, 0, 1]);
  });

  it("load meshes, and report missing ones", async () => {
    const { send, display, connection } = started();
    const stl =
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid";
    connection.assets.set("package://p/there.stl", new TextEncoder().encode(stl).buffer);
    send(
      { id: 1, type: Type.mesh, mesh_resource: "package://p/there.stl" },
      { id: 2, type: Type.mesh, mesh_resource: "package://p/gone.stl" },
    );
    await new Promise((resolve) => setTimeout(resolve, 20));
    expect(display.statuses.value.get("ns/2")).toMatchObject({
      level: "error",
      text: "Could not load mesh resource 'package://p/gone.stl'",
    });
    expect(parts(display.root).filter((part) => !(part instanceof InstancedMesh))).toHaveLength(1);
  });
});

describe("markers", () => {
  it("are replaced by their name, deleted, and deleted all together", () => {
    const { send, count } = started();
    send({ id: 1 }, { id: 1, type: Type.sphere }, { id: 2 }, { id: 1, ns: "other" });
    expect(count()).toBe(3);
    send({ id: 1, action: 2 });
    expect(count()).toBe(2);
    send({ action: 3 });
    expect(count()).toBe(0);
  });

  it("are removed after their lifetime", () => {
    const { send, connection, display, count } = started();
    connection.time = 1_000_000_000n;
    send({ id: 1, lifetime: { sec: 2, nsec: 0 } }, { id: 2 });
    display.update(2_900_000_000n, 0.01);
    expect(count()).toBe(2);
    display.update(3_000_000_000n, 0.01);
    expect(count()).toBe(1);
  });

  it("keep their pose, and only locked ones follow their frame", () => {
    const { send, frames, display } = started();
    send({ id: 1 }, { id: 2, frame_locked: true });
    frames.set("base", "map", [5, 0, 0]);
    display.update(1n, 0.01);
    const [mesh] = parts(display.root);
    const at = (index: number): number => {
      const matrix = new Matrix4();
      (mesh as InstancedMesh).getMatrixAt(index, matrix);
      return new Vector3().setFromMatrixPosition(matrix).x;
    };
    expect([at(0), at(1)]).toEqual([1, 5]);
  });

  it("list their namespaces, which can be switched off, also before they appear", () => {
    const { send, display, count } = started({ Namespaces: { hidden: false } });
    send({ id: 1, ns: "hidden" }, { id: 2, ns: "shown" });
    expect(display.namespaces.children.map((row) => row.name)).toEqual(["hidden", "shown"]);
    expect(count()).toBe(1);
    const hidden = display.namespaces.get("hidden");
    if (hidden !== undefined) hidden.value.value = true;
    display.update(1n, 0.01);
    expect(count()).toBe(2);
  });

  it("wait for their transform, and report it after a second", () => {
    const { send, display, frames, count } = started();
    send({ header: { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "late" } });
    expect(display.statuses.value.has("ns/0")).toBe(false);
    display.update(1n, 1.1);
    expect(display.statuses.value.get("ns/0")?.text).toBe("No transform from [late] to [map]");
    frames.set("late", "map");
    display.update(2n, 0.01);
    display.update(3n, 0.01);
    expect(count()).toBe(1);
    expect(display.statuses.value.has("ns/0")).toBe(false);
  });

  it("are received on the array's topic of a Marker, too, and in arrays", () => {
    const { connection, display, count } = started();
    connection.receive("/markers_array", { markers: [marker({ id: 1 }), marker({ id: 2 })] });
    display.update(1n, 0.01);
    expect(count()).toBe(2);
    const array = new MarkerArrayDisplay(setup().context);
    expect(array.topic).toBe("/visualization_marker_array");
  });

  it("are dropped with their subscriptions when the display stops", () => {
    const { send, display, connection, scene } = started();
    send({ id: 1 });
    display.stop();
    expect(connection.subscriptions("/markers") + connection.subscriptions("/markers_array")).toBe(0);
    expect(scene.displays.children).toHaveLength(0);
  });
});

describe("faults of a marker", () => {
  it.each([
    [
      { pose: { ...ORIGIN, orientation: { x: 0, y: 0, z: 0, w: 0 } } },
      "warn",
      "Uninitialized quaternion, assuming identity.",
    ],
    [
      { pose: { ...ORIGIN, orientation: { x: 0, y: 0, z: 0, w: 2 } } },
      "warn",
      "Unnormalized quaternion in marker message.",
    ],
    [{ scale: { x: 1, y: 0, z: 1 } }, "warn", "Scale contains 0.0 in x, y or z."],
    [{ color: { r: 1, g: 1, b: 1, a: 0 } }, "warn", "Marker is fully transparent (color.a is 0.0)."],
    [{ text: "x" }, "warn", "Non-empty text is ignored."],
    [
      { type: Type.lineStrip, scale: { x: 0.1, y: 0, z: 0 }, points: [point(0, 0)] },
      "error",
      "At least two points are required for a LINE_STRIP marker.",
    ],
    [
      { type: Type.lineList, scale: { x: 0.1, y: 0, z: 0 }, points: [] },
      "error",
      "Points should not be empty for specified marker type.",
    ],
    [
      { type: Type.triangleList, points: [point(0, 0)] },
      "error",
      "Number of points should be a multiple of 3 for TRIANGLE_LIST marker.",
    ],
    [
      { type: Type.text, text: " " },
      "warn",
      "scale.x and scale.y of TEXT_VIEW_FACING are ignored. \nText is empty or only consists of whitespace.",
    ],
    [{ type: Type.mesh }, "error", "Empty mesh_resource path."],
    [
      { pose: { ...ORIGIN, position: point(NaN, 0) } },
      "error",
      "Contains invalid floating point values (nans or infs)",
    ],
    [{ type: 42 }, "error", "Unknown marker type: 42"],
  ])("%j", (fields, level, text) => {
    expect(checkMarker(marker(fields))).toEqual({ level, text });
  });

  it("are none for a valid marker", () => {
    expect(checkMarker(marker())).toBeNull();
    expect(
      checkMarker(marker({ type: Type.arrow, points: [point(0, 0), point(1, 0)], scale: { x: 0.1, y: 0.2, z: 0 } })),
    ).toBeNull();
  });
});
