/** Projection of a calibrated camera, so that the scene lies over its picture. */

import { Matrix4, Quaternion, Vector3 } from "three";

import type { Transform } from "../../frames/transform";
import type { CameraInfo } from "../../protocol/generated/ros_messages";
import { areFinite } from "../../frames/valid";

/** rviz's planes [m]. */
const NEAR = 0.01;
const FAR = 100;
/** Rotation between the optical frame (z forward, y down) and a camera of the scene (z backward, y up). */
const OPTICAL_FROM_CAMERA = new Quaternion(1, 0, 0, 0);

export interface Size {
  readonly width: number;
  readonly height: number;
}

/** Size of the image that a calibration is for; a calibration without a size has the picture's. */
export function calibratedSize({ width, height }: CameraInfo, picture: Size): Size {
  return { width: width || picture.width, height: height || picture.height };
}

/** Projection of rviz for a calibration of `size`, or rviz's error; zoom magnifies. */
export function projection({ P }: CameraInfo, { width, height }: Size, zoom: number): Matrix4 | string {
  if (!areFinite(P) || P.length !== 12) return "Contains invalid floating point values (nans or infs)";
  const [fx = 0, , cx = 0, , , fy = 0, cy = 0] = P;
  if (width === 0 || height === 0) {
    return "Could not determine width/height of image due to malformed CameraInfo (either width or height is 0)";
  }
  if (fx === 0 || fy === 0) return "CameraInfo/P resulted in an invalid position calculation (nans or infs)";
  return new Matrix4().set(
    (2 * fx * zoom) / width,
    0,
    2 * (0.5 - cx / width) * zoom,
    0,
    0,
    (2 * fy * zoom) / height,
    2 * (cy / height - 0.5) * zoom,
    0,
    0,
    0,
    -(FAR + NEAR) / (FAR - NEAR),
    (-2 * FAR * NEAR) / (FAR - NEAR),
    0,
    0,
    -1,
    0,
  );
}

/** Pose of the scene's camera; a right camera of a stereo pair stands beside its frame by P's fourth column. */
export function cameraPose({ P }: CameraInfo, { position, orientation }: Transform): Transform {
  const [fx = 1, , , tx = 0, , fy = 1, , ty = 0] = P;
  const offset = new Vector3(-tx / fx, -ty / fy, 0).applyQuaternion(orientation);
  return { position: offset.add(position), orientation: orientation.clone().multiply(OPTICAL_FROM_CAMERA) };
}

/** Rectangle of a picture in a canvas of the calibration's size [px]: its region of interest, zoomed about the middle. */
export function pictureRectangle(
  { roi }: CameraInfo,
  { width, height }: Size,
  zoom: number,
): [x: number, y: number, width: number, height: number] {
  const isRegion = roi.width > 0 || roi.height > 0;
  const [x, y, w, h] = isRegion ? [roi.x_offset, roi.y_offset, roi.width, roi.height] : [0, 0, width, height];
  return [width / 2 + (x - width / 2) * zoom, height / 2 + (y - height / 2) * zoom, w * zoom, h * zoom];
}
