/** Marks of the world itself: its origin, and the wind. */

import { Group, Vector3, type Object3D } from "three";

import type { Triple } from "../simulated_world";
import { COLORS, arrow, triad } from "./overlay_shapes";

/** Gap between the wind's arrows, their height over the ground [m], and how many lie along each side. */
const WIND = { gap: 2, height: 1, count: 5 };
/** Length of an arrow for 1 m/s, and the longest [m]. */
const LENGTH = { unit: 0.2, longest: 1.6 };

export function drawOrigin(): Object3D {
  return triad(1);
}

/** Arrows with the wind [m/s], over the world's origin; none where it is still. */
export function drawWind(wind: Triple): Object3D {
  const group = new Group();
  const direction = new Vector3(...wind);
  const speed = direction.length();
  if (!(speed > 0)) return group;
  const length = Math.min(LENGTH.longest, LENGTH.unit * speed);
  direction.divideScalar(speed);
  for (let i = 0; i < WIND.count ** 2; i += 1) {
    const mark = arrow(direction, length, COLORS.frustum);
    const offset = (k: number): number => (k - (WIND.count - 1) / 2) * WIND.gap;
    mark.position.set(offset(i % WIND.count), offset(Math.floor(i / WIND.count)), WIND.height);
    group.add(mark);
  }
  return group;
}
