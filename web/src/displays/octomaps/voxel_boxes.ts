/** Voxels of an octomap as boxes, with MoveIt's colors. */

import { Matrix4 } from "three";

import { Instances } from "../../shapes/instances";
import { BOX } from "../../shapes/solids";
import type { Voxels } from "./octomap_reader";

/** Share of the hues that MoveIt uses for heights. */
const HUES = 0.8;
const matrix = new Matrix4();

export const OCCUPIED = "Occupied Voxels";
export const FREE = "Free Voxels";
/** Values of the property "Voxel Rendering". */
export const RENDERINGS = [OCCUPIED, FREE, "All Voxels"];
/** Values of the property "Voxel Coloring". */
export const COLORINGS = ["Cell Color", "Z-Axis", "Cell Probability"];

export interface VoxelLook {
  /** One of `RENDERINGS`. */
  readonly rendering: string;
  /** One of `COLORINGS`; voxels of a tree without colors are white. */
  readonly coloring: string;
  readonly alpha?: number;
  /** Heights of the middles of the shown voxels [m]. */
  readonly heights?: readonly [number, number];
}

export function voxelBoxes(
  voxels: Voxels,
  { rendering, coloring, alpha = 1, heights = [-Infinity, Infinity] }: VoxelLook,
): Instances {
  const { boxes, probabilities, colors, count } = voxels;
  const shown: number[] = [];
  let [low, high] = [Infinity, -Infinity];
  for (let index = 0; index < count; index++) {
    const z = boxes[4 * index + 2] ?? 0;
    const half = (boxes[4 * index + 3] ?? 0) / 2;
    low = Math.min(low, z - half);
    high = Math.max(high, z + half);
    const isShown = (probabilities[index] ?? 0) >= 0.5 ? rendering !== FREE : rendering !== OCCUPIED;
    if (isShown && z >= heights[0] && z <= heights[1]) shown.push(index);
  }
  const instances = new Instances(BOX, {}, Math.max(1, shown.length));
  instances.begin(shown.length);
  shown.forEach((index, at) => {
    const [x = 0, y = 0, z = 0, size = 0] = boxes.subarray(4 * index, 4 * index + 4);
    instances.setMatrixAt(at, matrix.makeScale(size, size, size).setPosition(x, y, z));
    const probability = probabilities[index] ?? 0;
    const [red = 1, green = 1, blue = 1] =
      coloring === "Cell Probability"
        ? [1 - probability, probability, 0]
        : coloring === "Cell Color"
          ? colors.subarray(3 * index, 3 * index + 3)
          : heightColor((z - low) / (high - low || 1));
    instances.setRgbaAt(at, red, green, blue, alpha);
  });
  instances.finish();
  return instances;
}

/** Color of a height, 0 lowest, 1 highest: hues from magenta down to red. */
function heightColor(share: number): readonly [number, number, number] {
  const hue = 6 * (1 - Math.min(1, Math.max(0, share))) * HUES;
  const part = (offset: number): number => Math.min(1, Math.max(0, Math.abs(((hue + offset) % 6) - 3) - 1));
  return [part(0), part(4), part(2)];
}
