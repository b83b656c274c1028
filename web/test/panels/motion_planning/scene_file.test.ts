import { expect, test } from "vitest";

import { collisionObject, readScene, SceneFileError, writeScene } from "../../../src/panels/motion_planning/scene_file";

const POSE = { position: { x: 1, y: 2, z: 3 }, orientation: { x: 0, y: 0, z: 1, w: 0 } };

/** As MoveIt writes it since Noetic. */
const NEW = `kitchen
* table
0.5 0 0.25
0 0 0 1
1
box
1 0.8 0.5
0 0 0
0 0 0 1
1 0 0 1
1
edge
0.5 0 0
0 0 0 1
* cup
1 2 3
0 0 1 0
1
cylinder
0.04 0.1
0 0 0
0 0 0 1
0 0 0 0
0
.
`;

/** As it was before: objects have no pose of their own. */
const OLD = `(noname)
* cup
2
sphere
0.1
1 2 3
0 0 0 1
0 0 0 0
mesh
3 1
0 0 0
1 0 0
0 1 0
0 1 2
0 0 0
0 0 0 1
0 0 0 0
.
`;

test("files of MoveIt are read, with poses, colors and subframes", () => {
  const { name, objects, colors } = readScene(NEW, "world");
  const [table, cup] = objects;
  expect(name).toBe("kitchen");
  expect(table?.pose.position).toEqual({ x: 0.5, y: 0, z: 0.25 });
  expect(table?.header.frame_id).toBe("world");
  expect(table?.subframe_names).toEqual(["edge"]);
  expect(colors.get("table")).toEqual({ r: 1, g: 0, b: 0, a: 1 });
  expect(colors.has("cup")).toBe(false);
  expect([...(cup?.primitives[0]?.dimensions ?? [])]).toEqual([0.1, 0.04]); // height and radius
});

test("older files are read, too", () => {
  const [cup] = readScene(OLD, "world").objects;
  expect(cup?.pose.position).toEqual({ x: 0, y: 0, z: 0 });
  expect(cup?.primitive_poses[0]?.position).toEqual({ x: 1, y: 2, z: 3 });
  expect([...(cup?.meshes[0]?.triangles[0]?.vertex_indices ?? [])]).toEqual([0, 1, 2]);
});

test("what is written is read as the same", () => {
  const scene = readScene(NEW, "world");
  expect(writeScene(scene)).toBe(NEW);
  const cone = collisionObject("cone", "world", POSE, {
    primitives: [{ type: 4, dimensions: Float64Array.of(0.3, 0.1) }],
    planes: [{ coef: Float64Array.of(0, 0, 1, -0.5) }],
  });
  const { objects } = readScene(writeScene({ name: "x", objects: [cone], colors: new Map() }), "world");
  expect(objects).toEqual([cone]);
});

test("a damaged file is refused with its line", () => {
  const faults: readonly (readonly [string, string])[] = [
    ["", "The file ends"],
    ["x\n* cup\n1\nball\n", 'Line 4: no shape "ball"'],
    ["x\n* cup\n1\nsphere\nbig\n", "Line 5: expected 1 numbers"],
    ["x\n* cup\n-1\n", "Line 3: expected numbers of parts"],
    ["x\n* cup\n1\nmesh\n1 1\n0 0 0\n0 1 2\n", "a triangle names a vertex that is not among the 1"],
    ["x\ncup\n", 'Line 2: expected "* NAME"'],
  ];
  for (const [text, fault] of faults) {
    expect(() => readScene(text, "world")).toThrow(SceneFileError);
    expect(() => readScene(text, "world")).toThrow(fault);
  }
});
