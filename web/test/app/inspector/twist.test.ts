import { Euler, Quaternion, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { rollPitchYaw, twistOf } from "../../../src/app/inspector/twist";

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

  it("is none without time between", () => {
    const pose = { time: 1, position: new Vector3(), orientation: new Quaternion() };
    expect(twistOf(pose, pose)).toBeNull();
  });
});

it("takes roll, pitch and yaw as URDF has them", () => {
  const angles = rollPitchYaw(new Quaternion().setFromEuler(new Euler(0.1, -0.4, 2, "ZYX")));
  [0.1, -0.4, 2].forEach((angle, index) => expect(angles[index]).toBeCloseTo(angle, 9));
});
