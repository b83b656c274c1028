/** Points of a depth image: sensor_msgs/Image of 16UC1 [mm] or 32FC1 [m] with its camera's projection. */

import type { CameraInfo, Image } from "../../protocol/generated/ros_messages";
import { Cloud, FLOAT32 } from "../clouds/cloud";
import { readNumbers, type Pixels } from "../pictures/pixels";
import { areFinite } from "../../frames/valid";

const CHANNELS = ["x", "y", "z", "rgb"].map((name, word) => ({ name, offset: 4 * word, datatype: FLOAT32 }));
const STRIDE = CHANNELS.length;
const WHITE = 0xffffff;

/** Metres of a number of an encoding. */
const METRES = new Map([
  ["16UC1", 0.001],
  ["mono16", 0.001],
  ["32FC1", 1],
]);

/** Points in the camera's optical frame, or rviz's error; `color` has the same size. */
export function depthPoints(depth: Image, info: CameraInfo, color: Pixels | null): Cloud | string {
  const { width, height, encoding, step, data } = depth;
  const metres = METRES.get(encoding);
  if (metres === undefined) return "Depth image has invalid format (only 16 bit and float are supported)!";
  if (width === 0 || height === 0) return `Depth image is zero-sized (${width}x${height})`;
  const bytes = encoding === "32FC1" ? 4 : 2;
  if (step < width * bytes || (height - 1) * step + width * bytes > data.length) {
    return `Data size (${data.length} bytes) does not match width (${width}), height (${height}) and step (${step}) of ${encoding}`;
  }
  const mismatch = sizeMismatch(depth, info);
  if (mismatch !== null) return mismatch;
  if (color !== null && (color.width !== width || color.height !== height)) {
    return `Depth image resolution (${width}x${height}) does not match color image resolution (${color.width}x${color.height})`;
  }
  const [fx = 0, , cx = 0, , , fy = 0, cy = 0] = info.P;
  if (!areFinite([fx, fy, cx, cy]) || fx === 0 || fy === 0)
    return "Camera info contains invalid floating point values (nans or infs)";
  const [binX, binY] = [Math.max(1, info.binning_x), Math.max(1, info.binning_y)];
  const [midX, midY] = [(cx - info.roi.x_offset) / binX, (cy - info.roi.y_offset) / binY];

  const numbers = readNumbers(depth);
  const words = new Uint32Array(numbers.length * STRIDE);
  const floats = new Float32Array(words.buffer);
  let count = 0;
  for (let v = 0, at = 0; v < height; v++) {
    for (let u = 0; u < width; u++, at++) {
      const z = (numbers[at] ?? NaN) * metres;
      if (!Number.isFinite(z) || (bytes === 2 && z === 0)) continue;
      const to = count * STRIDE;
      floats[to] = ((u - midX) * binX * z) / fx;
      floats[to + 1] = ((v - midY) * binY * z) / fy;
      floats[to + 2] = z;
      words[to + 3] = color === null ? WHITE : colorAt(color.rgba, at);
      count += 1;
    }
  }
  return new Cloud(count, words.subarray(0, count * STRIDE), STRIDE, CHANNELS);
}

function colorAt(rgba: Uint8ClampedArray, index: number): number {
  return ((rgba[4 * index] ?? 0) << 16) | ((rgba[4 * index + 1] ?? 0) << 8) | (rgba[4 * index + 2] ?? 0);
}

function sizeMismatch(
  { width, height }: Image,
  { roi, binning_x, binning_y, width: infoWidth, height: infoHeight }: CameraInfo,
): string | null {
  const [binX, binY] = [Math.max(1, binning_x), Math.max(1, binning_y)];
  const [roiWidth, roiHeight] = [roi.width || infoWidth, roi.height || infoHeight];
  const [expectedWidth, expectedHeight] = [Math.floor(roiWidth / binX), Math.floor(roiHeight / binY)];
  if (expectedWidth === width && expectedHeight === height) return null;
  return (
    `Depth image size and camera info don't match: ${width} x ${height} vs ${expectedWidth} x ${expectedHeight}` +
    `(binning: ${binX} x ${binY}, ROI size: ${roiWidth} x ${roiHeight})`
  );
}

/** rviz's size of a point 1 m away: as wide as a pixel of the image sees. */
export function autoSize(info: CameraInfo, factor: number): number {
  const size = (factor * Math.max(1, info.binning_x)) / (info.K[0] ?? 0);
  return Number.isFinite(size) ? size : 0;
}

/** The topic of the camera's projection, beside its images. */
export function cameraInfoTopic(imageTopic: string): string {
  return imageTopic.replace(/[^/]*$/, "camera_info");
}
