/** Snapping of positions to a grid, and of angles to steps. */

import { Quaternion, Vector3 } from "three";

import type { Transform } from "../../frames/transform";

/** Snap a position to the grid, in the directions in which it has moved. */
export function snapToGrid(to: Transform, from: Transform, cell: number): void {
  for (const axis of ["x", "y", "z"] as const) {
    if (Math.abs(to.position[axis] - from.position[axis]) > 1e-6)
      to.position[axis] = Math.round(to.position[axis] / cell) * cell;
  }
}

/** Turn by whole steps [rad] from where a turn began. */
export function snapToAngle(to: Transform, from: Transform, step: number): void {
  const turn = to.orientation.clone().multiply(from.orientation.clone().invert());
  const axis = new Vector3(turn.x, turn.y, turn.z);
  if (axis.lengthSq() < 1e-12) return;
  const angle = 2 * Math.atan2(axis.length(), turn.w);
  const snapped = new Quaternion().setFromAxisAngle(axis.normalize(), Math.round(angle / step) * step);
  to.orientation.copy(snapped.multiply(from.orientation));
}
