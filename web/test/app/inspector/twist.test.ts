import { Euler, Quaternion, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { MotionSamples, rollPitchYaw, twistOf } from "../../../src/app/inspector/twist";

const turned = (axis: Vector3, angle: number): Quaternion => new Quaternion().setFromAxisAngle(axis, angle);

describe("the twist between two poses", () => {
  it("is the rate of position and of rotation", () => {
    const axis = new Vector3(0, 0.6, 0.8);
    const first = { time: 1, position: new Vector3(0, 0, 0), orientation: turned(axis, 3) };
    const second = { time: 1.5, position: new Vector3(0.5, 0, -1), orientation: turned(axis, 3.5) };
    const twist = twistOf(first, second);
    expect(twist?.linear).toEqual([1, 0, -2]);
    [0, 0.6, 0.8].forEach((part, index) => expect(twist?.angular[index]).toBeCloseTo(part, 9));
  });

  it("is null without time between", () => {
    const pose = { time: 1, position: new Vector3(), orientation: new Quaternion() };
    expect(twistOf(pose, pose)).toBeNull();
  });
});

describe("samples of motion", () => {
  const at = (time: number, x: number): Parameters<MotionSamples["add"]>[0] => ({
    time,
    position: new Vector3(x, 0, 0),
    orientation: new Quaternion(),
  });
  const speedOf = (...poses: readonly (readonly [time: number, x: number])[]): number | undefined => {
    const samples = new MotionSamples();
    for (const [time, x] of poses) samples.add(at(time, x));
    return samples.twist()?.linear[0];
  };

  it("have the mean speed over the last 0.2 s", () => {
    expect(speedOf([0, 0])).toBeUndefined();
    expect(speedOf([0, 0], [0.1, 0.2], [0.25, 0.5], [0.3, 0.6])).toBeCloseTo(2, 9);
    expect(speedOf([0, 0], [0.1, 0.2], [0.2, 0.2], [0.3, 0.2])).toBeCloseTo(0, 9);
  });

  it("have the mean speed over a longer time at a lower rate", () => {
    expect(speedOf([0, 0], [1, 2], [2, 6])).toBeCloseTo(4, 9);
    expect(speedOf([0, 0], [5, 20], [5.05, 20.1])).toBeCloseTo(2, 9);
  });

  it("drop samples from before time went back", () => {
    expect(speedOf([5, 0], [5.1, 1], [0, 7])).toBeUndefined();
    expect(speedOf([5, 0], [5.1, 1], [0, 7], [0.1, 7.3])).toBeCloseTo(3, 9);
  });
});

it("computes roll, pitch and yaw as URDF defines them", () => {
  const angles = rollPitchYaw(new Quaternion().setFromEuler(new Euler(0.1, -0.4, 2, "ZYX")));
  [0.1, -0.4, 2].forEach((angle, index) => expect(angles[index]).toBeCloseTo(angle, 9));
});
