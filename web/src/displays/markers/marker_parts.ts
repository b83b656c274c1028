/** Solid parts of markers: boxes, spheres, cylinders, arrows and lists of them, as instances of unit shapes. */

import { Matrix4, Quaternion, Vector3 } from "three";

import type { ColorRGBA, Marker } from "../../protocol/generated/ros_messages";
import { Type } from "./marker_type";

export type PartKind = "box" | "sphere" | "cylinder" | "shaft" | "head" | "list box" | "list sphere";
/** The matrix is in the marker's own frame and is used again for the next part. */
export type Emit = (kind: PartKind, matrix: Matrix4, color: ColorRGBA) => void;

/** Ratios of an arrow: shaft and head to its length, and the head's diameter to the shaft's. */
const SHAFT_LENGTH = 0.77;
const HEAD_LENGTH = 0.23;
const HEAD_WIDTH = 2;

const matrix = new Matrix4();
const position = new Vector3();
const direction = new Vector3();
const scale = new Vector3();
const turn = new Quaternion();
const UNTURNED = new Quaternion();
const X = new Vector3(1, 0, 0);

export function isSolid(type: number): boolean {
  return type <= Type.cylinder || type === Type.cubeList || type === Type.sphereList;
}

/** Emit the parts of a solid marker. */
export function forEachPart(marker: Marker, emit: Emit): void {
  const { type, scale: size, points, colors, color } = marker;
  if (type === Type.arrow) {
    if (points.length === 2) arrowBetween(marker, emit);
    else
      arrow(
        size.x * SHAFT_LENGTH,
        size.x * HEAD_LENGTH,
        [size.y, size.z],
        [HEAD_WIDTH * size.y, HEAD_WIDTH * size.z],
        color,
        emit,
      );
    return;
  }
  if (type === Type.cubeList || type === Type.sphereList) {
    const kind = type === Type.cubeList ? "list box" : "list sphere";
    scale.set(size.x, size.y, size.z);
    points.forEach((point, index) => {
      matrix.compose(position.set(point.x, point.y, point.z), UNTURNED, scale);
      emit(kind, matrix, colors[index] ?? color);
    });
    return;
  }
  const kind = type === Type.cube ? "box" : type === Type.sphere ? "sphere" : "cylinder";
  emit(kind, matrix.makeScale(size.x, size.y, size.z), color);
}

/** An arrow from the first point to the second: scale is shaft's and head's diameter and the head's length. */
function arrowBetween({ points: [from, to], scale: size, color }: Marker, emit: Emit): void {
  if (from === undefined || to === undefined) return;
  direction.set(to.x - from.x, to.y - from.y, to.z - from.z);
  const length = direction.length();
  if (length === 0) return;
  const head = size.z === 0 ? HEAD_LENGTH * length : Math.max(0, Math.min(size.z, length));
  turn.setFromUnitVectors(X, direction.divideScalar(length));
  position.set(from.x, from.y, from.z);
  emit("shaft", matrix.compose(position, turn, scale.set(length - head, size.x, size.x)), color);
  position.addScaledVector(direction, length - head);
  emit("head", matrix.compose(position, turn, scale.set(head, size.y, size.y)), color);
}

function arrow(
  shaft: number,
  head: number,
  [shaftY, shaftZ]: readonly [number, number],
  [headY, headZ]: readonly [number, number],
  color: ColorRGBA,
  emit: Emit,
): void {
  emit("shaft", matrix.compose(position.set(0, 0, 0), UNTURNED, scale.set(shaft, shaftY, shaftZ)), color);
  emit("head", matrix.compose(position.set(shaft, 0, 0), UNTURNED, scale.set(head, headY, headZ)), color);
}
