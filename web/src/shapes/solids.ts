/** Geometries of rviz's shapes at unit size, made once and shared; do not dispose of them. */

import { BoxGeometry, BufferAttribute, CylinderGeometry, SphereGeometry, type BufferGeometry } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";

const SIDES = 24;

/** Cube of 1 m about its middle. */
export const BOX: BufferGeometry = new BoxGeometry(1, 1, 1);
/** Sphere of 1 m diameter. */
export const SPHERE: BufferGeometry = new SphereGeometry(0.5, 24, 16).rotateX(Math.PI / 2);
/** Cylinder of 1 m diameter and height about its middle, along z. */
export const CYLINDER: BufferGeometry = new CylinderGeometry(0.5, 0.5, 1, SIDES).rotateX(Math.PI / 2);
/** Cylinder from the origin to (1, 0, 0), 1 m in diameter. */
export const SHAFT: BufferGeometry = new CylinderGeometry(0.5, 0.5, 1, SIDES)
  .rotateZ(-Math.PI / 2)
  .translate(0.5, 0, 0);
/** Cone from its base at the origin to its tip at (1, 0, 0), 1 m in diameter. */
export const HEAD: BufferGeometry = new CylinderGeometry(0, 0.5, 1, SIDES).rotateZ(-Math.PI / 2).translate(0.5, 0, 0);

/** Proportions of an arrow along x from the origin [m]. */
export interface ArrowProportions {
  readonly shaftLength: number;
  readonly shaftDiameter: number;
  readonly headLength: number;
  readonly headDiameter: number;
}

/** One geometry of shaft and head, for instances; the caller disposes of it. */
export function arrowGeometry(arrow: ArrowProportions): BufferGeometry {
  const shaft = SHAFT.clone().scale(arrow.shaftLength, arrow.shaftDiameter, arrow.shaftDiameter);
  const head = HEAD.clone().scale(arrow.headLength, arrow.headDiameter, arrow.headDiameter);
  return mergeGeometries([shaft, head.translate(arrow.shaftLength, 0, 0)]);
}

type Rgba = readonly [number, number, number, number];
const AXIS_COLORS: readonly Rgba[] = [
  [1, 0, 0, 1],
  [0, 1, 0, 1],
  [0, 0, 1, 1],
];

/** One geometry of three colored axes (`vertexRgba`), for instances; rviz's radius is the diameter of its cylinders. */
export function axesGeometry(length: number, radius: number): BufferGeometry {
  const axis = SHAFT.clone().scale(length, radius, radius);
  const axes = [axis, axis.clone().rotateZ(Math.PI / 2), axis.clone().rotateY(-Math.PI / 2)];
  return mergeGeometries(axes.map((geometry, index) => paint(geometry, AXIS_COLORS[index] ?? [1, 1, 1, 1])));
}

/** Give every vertex of a geometry one color, 0…1. */
function paint(geometry: BufferGeometry, rgba: Rgba): BufferGeometry {
  const count = geometry.getAttribute("position").count;
  const colors = new Float32Array(count * 4);
  for (let vertex = 0; vertex < count; vertex++) colors.set(rgba, vertex * 4);
  return geometry.setAttribute("vertexRgba", new BufferAttribute(colors, 4));
}

/** Lightness of the faces of rviz's boxes in clouds: +x, -x, +y, -y, +z, -z. */
const CLOUD_BOX_FACES = [0.5, 1, 0.6, 0.4, 0.9, 0.6] as const;

/** Cube of 1 m with rviz's lightness per face (`vertexRgba`). */
export const CLOUD_BOX: BufferGeometry = paint(BOX.clone(), [1, 1, 1, 1]);
const faces = CLOUD_BOX.getAttribute("vertexRgba");
for (let vertex = 0; vertex < faces.count; vertex++) {
  const light = CLOUD_BOX_FACES[Math.floor(vertex / 4)] ?? 1;
  faces.setXYZ(vertex, light, light, light);
}
