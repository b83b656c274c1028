/** Points of a cloud under a pointer or within a box. */

import { Matrix4, OrthographicCamera, Ray, Vector3, type Raycaster } from "three";

import type { Cloud } from "./cloud";

/** Angle around the pointer's ray within which small points are picked, with perspective [rad]. */
const PICK_ANGLE = 0.005;

/**
 * The nearest point whose middle is within `radius` [m] of a ray, else the point at the least angle to the ray;
 * null: none. `matrix` is the cloud's pose in the world.
 */
export function nearestPoint(
  cloud: Cloud,
  radius: number,
  matrix: Matrix4,
  raycaster: Raycaster,
): { point: Vector3; distance: number; index: number } | null {
  const { origin, direction } = new Ray().copy(raycaster.ray).applyMatrix4(new Matrix4().copy(matrix).invert());
  const isOrthographic = raycaster.camera instanceof OrthographicCamera;
  const reach = (along: number): number =>
    Math.max(radius, isOrthographic ? raycaster.params.Points.threshold : PICK_ANGLE * along);
  const [x = 0, y = 0, z = 0] = ["x", "y", "z"].map((axis) => (cloud.channel(axis)?.offset ?? 0) / 4);
  const { floats, stride } = cloud;
  let best = -1;
  let minRank = Infinity;
  for (let index = 0, at = 0; index < cloud.count; index++, at += stride) {
    const dx = (floats[at + x] ?? NaN) - origin.x;
    const dy = (floats[at + y] ?? NaN) - origin.y;
    const dz = (floats[at + z] ?? NaN) - origin.z;
    const along = dx * direction.x + dy * direction.y + dz * direction.z;
    if (!(along > 0)) continue;
    const aside = Math.sqrt(Math.max(0, dx * dx + dy * dy + dz * dz - along * along));
    if (aside > reach(along)) continue;
    const rank = aside <= radius ? along * 1e-6 : 1 + aside / along; // points that the ray hits come first
    if (rank < minRank) [minRank, best] = [rank, index];
  }
  if (best < 0) return null;
  const at = best * stride;
  const point = new Vector3(floats[at + x], floats[at + y], floats[at + z]).applyMatrix4(matrix);
  const distance = point.distanceTo(raycaster.ray.origin);
  return distance < raycaster.near || distance > raycaster.far ? null : { point, distance, index: best };
}

/** Indices of the points within a box of the picture; `matrix` is the cloud's pose in the world. */
export function pointsWithin(cloud: Cloud, matrix: Matrix4, contains: (point: Vector3) => boolean): number[] {
  const [x = 0, y = 0, z = 0] = ["x", "y", "z"].map((axis) => (cloud.channel(axis)?.offset ?? 0) / 4);
  const { floats, stride } = cloud;
  const indices: number[] = [];
  const point = new Vector3();
  for (let index = 0, at = 0; index < cloud.count; index++, at += stride) {
    point.set(floats[at + x] ?? NaN, floats[at + y] ?? NaN, floats[at + z] ?? NaN).applyMatrix4(matrix);
    if (contains(point)) indices.push(index);
  }
  return indices;
}
