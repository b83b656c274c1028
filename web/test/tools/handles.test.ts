import { Quaternion, Vector3 } from "three";
import { expect, it } from "vitest";

import type { Transform } from "../../src/frames/transform";
import { LatestRequest } from "../../src/protocol/latest_request";
import { snapToAngle, snapToGrid } from "../../src/tools/handles/snapping";

const Z = new Vector3(0, 0, 1);

function at(x: number, y: number, z: number, yaw = 0): Transform {
  return { position: new Vector3(x, y, z), orientation: new Quaternion().setFromAxisAngle(Z, yaw) };
}

it("snaps only what has moved to the grid", () => {
  const to = at(0.43, 0.777, 0.2);
  snapToGrid(to, at(0.1, 0.777, 0.2), 0.1);
  expect(to.position.toArray().map((part) => Number(part.toFixed(6)))).toEqual([0.4, 0.777, 0.2]);
});

it.each([
  [0.3, 0.25],
  [-0.3, -0.25],
  [0.1, 0],
])("turns by steps from the start: %f", (by, snapped) => {
  const to = at(0, 0, 0, 1 + by);
  snapToAngle(to, at(0, 0, 0, 1), 0.25);
  expect(to.orientation.angleTo(at(0, 0, 0, 1 + snapped).orientation)).toBeLessThan(1e-6);
});

it("sends the newest waiting request after an answer, and none after a refusal", async () => {
  const sent: number[] = [];
  const answers: ((isDone: boolean) => void)[] = [];
  let refusals = 0;
  const requests = new LatestRequest(() => (refusals += 1));
  const send = (number: number): void =>
    requests.send(() => {
      sent.push(number);
      return new Promise((resolve) => answers.push(resolve));
    });
  [1, 2, 3].forEach(send);
  expect(sent).toEqual([1]);
  answers[0]?.(true);
  await Promise.resolve();
  expect(sent).toEqual([1, 3]);
  send(4);
  answers[1]?.(false);
  await Promise.resolve();
  expect(sent).toEqual([1, 3]);
  expect(refusals).toBe(1);
});
