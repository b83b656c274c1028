/** Frustum of a camera, from its lens to its far plane. */

import { Group, type Object3D } from "three";

import type { CameraInfo } from "../../protocol/generated/page_messages";
import { place } from "./mass";
import { COLORS, lines } from "./overlay_shapes";

/** Longest pyramid that is drawn [m]. */
const LONGEST = 3;
/** Widest angle whose pyramid can be drawn [rad]. */
const WIDEST = 2.8;

export function drawFrustum(camera: CameraInfo): Object3D {
  const { horizontal_fov, width, height, near, far } = camera;
  const across = Math.tan(Math.min(horizontal_fov, WIDEST) / 2);
  const up = (across * height) / width;
  const corner = (distance: number, i: number): number[] => [
    distance,
    (i === 0 || i === 3 ? 1 : -1) * across * distance,
    (i < 2 ? 1 : -1) * up * distance,
  ];
  const end = Math.max(near, Math.min(far, LONGEST));
  const sides = [0, 1, 2, 3];
  const ring = (distance: number): number[] =>
    sides.flatMap((i) => [...corner(distance, i), ...corner(distance, (i + 1) % 4)]);
  const edges = sides.flatMap((i) => [0, 0, 0, ...corner(end, i)]);
  const group = new Group();
  place(group, camera.pose);
  group.add(lines([...ring(near), ...ring(end), ...edges], COLORS.frustum));
  return group;
}
