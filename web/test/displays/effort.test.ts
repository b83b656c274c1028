// @vitest-environment jsdom
import { Box3, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { Effort, rainbow } from "../../src/displays/effort";
import { BillboardLines } from "../../src/shapes/billboard_lines";
import { setup } from "./support";

const URDF = `<robot name="arm"><link name="base"/><link name="tip"/><link name="slide"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 1 0"/><limit effort="20"/></joint>
  <joint name="push" type="prismatic"><parent link="tip"/><child link="slide"/><limit effort="20"/></joint></robot>`;

function started(effort: readonly number[], properties: object = {}): Effort {
  const { connection, frames, context } = setup();
  frames.set("tip", "map", [1, 0, 0]);
  connection.advertise("/joint_states", "sensor_msgs/JointState");
  connection.setParameter("/robot_description", URDF);
  const display = new Effort(context);
  display.load({ Topic: "joint_states", ...properties });
  display.start();
  const header = { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "" };
  connection.receive("/joint_states", {
    header,
    name: ["turn", "push"],
    position: [],
    velocity: [],
    effort: Float64Array.from(effort),
  });
  display.update(1n, 0.1);
  return display;
}

function lines(display: Effort): BillboardLines[] {
  const lines: BillboardLines[] = [];
  display.root.traverse((part) => part instanceof BillboardLines && lines.push(part));
  return lines;
}

describe("Effort", () => {
  it("draws a ring about the axis of each turning joint, as large as its effort", () => {
    const display = started([20, 5], { Scale: 2 });
    const [ring, ...others] = lines(display);
    expect(others).toEqual([]);
    const points = ring?.geometry.getAttribute("segmentStart");
    display.root.updateMatrixWorld(true);
    const box = new Box3();
    for (let k = 0; k < (ring?.segments ?? 0); k++) {
      box.expandByPoint(
        new Vector3()
          .fromBufferAttribute(points as never, k)
          .applyMatrix4(ring?.matrixWorld ?? display.root.matrixWorld),
      );
    }
    const size = box.getSize(new Vector3());
    expect(size.y).toBeCloseTo(0);
    expect(Math.max(size.x, size.z)).toBeCloseTo(2 * 1.1, 1);
    expect(ring?.geometry.getAttribute("startRgba").getX(0)).toBe(1);
  });

  it("shows no joint that is switched off", () => {
    expect(lines(started([20, 5], { Joints: { turn: false } }))).toEqual([]);
  });

  it("reports a missing robot description", () => {
    const display = started([20, 5], { "Robot Description": "nothing" });
    expect(display.statuses.value.get("URDF")?.text).toBe(
      "Parameter [nothing] does not exist, and was not found by searchParam()",
    );
  });

  it("goes through rviz's rainbow", () => {
    expect([rainbow(0), rainbow(0.2), rainbow(0.65), rainbow(1.05)]).toEqual(
      [
        [1, 0, 1],
        [0, 0, 1],
        [0.25, 1, 0],
        [1, 0, 0],
      ].map((color) => color.map((part) => expect.closeTo(part, 5) as unknown)),
    );
  });
});
