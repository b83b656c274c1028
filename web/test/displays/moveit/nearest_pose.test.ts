// @vitest-environment jsdom
import { Matrix4, Vector3 } from "three";
import { expect, test } from "vitest";

import { ArmModel } from "../../../src/displays/moveit/arm_model";
import { nearestPose } from "../../../src/displays/moveit/nearest_pose";
import { readSrdf } from "../../../src/displays/moveit/srdf";
import { readUrdf } from "../../../src/displays/robot/urdf";
import { SRDF, URDF } from "./robot";

const model = new ArmModel(readUrdf(URDF), readSrdf(SRDF));
const root = new Matrix4();

function tipAt(positions: ReadonlyMap<string, number>): Vector3 {
  return new Vector3().setFromMatrixPosition(model.forward(positions, root).get("tip") ?? root);
}

function reached(target: Matrix4, seed: Readonly<Record<string, number>>): ReadonlyMap<string, number> {
  const group = model.group("arm");
  if (group === undefined) throw new Error("no group");
  return nearestPose({ model, group, tip: "tip", target, seed: new Map(Object.entries(seed)), root });
}

test("a pose within reach is reached", () => {
  const target =
    model
      .forward(
        new Map([
          ["shoulder", 0.4],
          ["elbow", 0.9],
        ]),
        root,
      )
      .get("tip") ?? root;
  const found = reached(target, { shoulder: 0.2, elbow: 0.5 });
  expect(found.get("shoulder")).toBeCloseTo(0.4, 3);
  expect(found.get("elbow")).toBeCloseTo(0.9, 3);
});

test("towards a point beyond reach the arm stretches", () => {
  const far = new Matrix4().makeRotationZ(Math.PI / 2).setPosition(5, 0, 0); // as the tip is turned when stretched
  const tip = tipAt(reached(far, { shoulder: 0.3, elbow: -0.6 }));
  expect(tip.x).toBeGreaterThan(1.99);
});

test("joints stay within their limits", () => {
  const folded =
    model
      .forward(
        new Map([
          ["shoulder", 0],
          ["elbow", 2.5],
        ]),
        root,
      )
      .get("tip") ?? root;
  expect(reached(folded, { shoulder: 0, elbow: 1 }).get("elbow")).toBeLessThanOrEqual(1.5);
});
