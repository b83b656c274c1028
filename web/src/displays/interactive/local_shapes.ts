/** Shapes of an interactive marker that name frames of their own. */

import { Quaternion, Vector3 } from "three";

import type { FrameTree } from "../../frames/frame_tree";
import { NoTransform } from "../../frames/transform";
import type { InteractiveMarker, Marker, Pose } from "../../protocol/generated/ros_messages";
import { nanoseconds } from "../../protocol/ros_types";

/** Marker with all shapes relative to its pose; or the missing transform. */
export function withLocalShapes(marker: InteractiveMarker, frames: FrameTree): InteractiveMarker | NoTransform {
  const missing: NoTransform[] = [];
  const localShape = (shape: Marker): Marker => {
    const { frame_id: frame, stamp } = shape.header;
    if (frame === "") return shape;
    const transform = frames.lookup(marker.header.frame_id, frame, nanoseconds(stamp));
    if (transform instanceof NoTransform) {
      missing.push(transform);
      return shape;
    }
    const position = positionOf(shape.pose).applyQuaternion(transform.orientation).add(transform.position);
    const back = orientationOf(marker.pose).invert();
    const local = position.sub(positionOf(marker.pose)).applyQuaternion(back);
    const turn = back.multiply(transform.orientation).multiply(orientationOf(shape.pose));
    return { ...shape, pose: { position: xyz(local), orientation: { ...xyz(turn), w: turn.w } } };
  };
  const controls = marker.controls.map((control) => ({ ...control, markers: control.markers.map(localShape) }));
  return missing[0] ?? { ...marker, controls };
}

function positionOf({ position: { x, y, z } }: Pose): Vector3 {
  return new Vector3(x, y, z);
}

function orientationOf({ orientation: { x, y, z, w } }: Pose): Quaternion {
  const turn = new Quaternion(x, y, z, w);
  return turn.lengthSq() === 0 ? turn.identity() : turn.normalize();
}

function xyz({ x, y, z }: { readonly x: number; readonly y: number; readonly z: number }): {
  x: number;
  y: number;
  z: number;
} {
  return { x, y, z };
}
