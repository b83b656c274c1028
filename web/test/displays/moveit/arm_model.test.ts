// @vitest-environment jsdom
import { Matrix4, Vector3 } from "three";
import { expect, test } from "vitest";

import { ArmModel } from "../../../src/displays/moveit/arm_model";
import { readSrdf, SrdfError } from "../../../src/displays/moveit/srdf";
import { readUrdf } from "../../../src/displays/robot/urdf";
import { SRDF, URDF } from "./robot";

const model = new ArmModel(readUrdf(URDF), readSrdf(SRDF));

function position(link: string, positions: Readonly<Record<string, number>>, root = new Matrix4()): number[] {
  const pose = model.forward(new Map(Object.entries(positions)), root).get(link);
  return new Vector3()
    .setFromMatrixPosition(pose ?? new Matrix4())
    .toArray()
    .map((value) => Number(value.toFixed(6)));
}

test("groups have the joints that are planned, their tips and states", () => {
  const arm = model.group("arm");
  expect(arm?.joints.map(({ name }) => name)).toEqual(["shoulder", "elbow"]);
  expect(arm?.tips).toEqual(["tip"]);
  expect(arm?.states.get("home")).toEqual(
    new Map([
      ["shoulder", 0.5],
      ["elbow", -1],
    ]),
  );
  expect([...(arm?.effectorLinks ?? [])]).toEqual(["finger", "thumb"]);
  expect(model.group("hand")?.joints.map(({ name }) => name)).toEqual(["grip"]);
  expect(model.group("all")?.joints.map(({ name }) => name)).toEqual(["shoulder", "elbow", "grip"]);
  expect([model.frame, model.rootLink, model.virtualJoint]).toEqual(["world", "base", "world_joint"]);
});

test("links stand where the joints put them", () => {
  expect(position("tip", {})).toEqual([2, 0, 0]);
  expect(position("tip", { shoulder: Math.PI / 2 })).toEqual([0, 2, 0]);
  expect(position("tip", { shoulder: Math.PI / 2, elbow: -Math.PI / 2 })).toEqual([1, 1, 0]);
  expect(position("finger", { grip: 0.05 })).toEqual([2, 0.05, 0]); // the wrist turns by 90 degrees
  expect(position("tip", {}, new Matrix4().makeTranslation(0, 0, 3))).toEqual([2, 0, 3]);
});

test("joints without a message are at 0, or in the middle of limits that exclude it; others follow", () => {
  const all = model.complete(new Map());
  expect(all.get("grip")).toBeCloseTo(0.03);
  expect(all.get("grip2")).toBeCloseTo(0.07);
  expect(model.complete(new Map([["grip", 0.02]])).get("grip2")).toBeCloseTo(0.05);
});

test("positions beyond limits are found; continuous joints have none", () => {
  expect(
    model.violations(
      new Map([
        ["elbow", 1.6],
        ["shoulder", 9],
      ]),
    ),
  ).toEqual(["elbow"]);
});

test("joints that loop, or hang on no link, are left out", () => {
  const looped = URDF.replace(
    "</robot>",
    '<joint name="loop" type="fixed"><parent link="tip"/><child link="upper"/></joint></robot>',
  );
  const robot = new ArmModel(readUrdf(looped), readSrdf(SRDF));
  expect(robot.forward(new Map(), new Matrix4()).size).toBe(6);
});

test("groups that name each other end", () => {
  const groups = '<robot><group name="a"><group name="b"/></group><group name="b"><group name="a"/></group></robot>';
  expect(new ArmModel(readUrdf(URDF), readSrdf(groups)).group("a")?.joints).toEqual([]);
});

test("a description that is no SRDF is refused with a sentence", () => {
  expect(() => readSrdf("<robot")).toThrow(SrdfError);
  expect(() => readSrdf("<sdf/>")).toThrow("begins with <sdf>, not <robot>");
});
