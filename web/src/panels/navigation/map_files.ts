/** Files of a map, as map_saver writes them. */

import { readMap } from "../../displays/maps/occupancy_map";
import type { OccupancyGrid, Quaternion } from "../../protocol/generated/ros_messages";

/** Probability limits of map_saver [%]: cells up to the first are free, cells from the second on are occupied. */
const FREE_MAX = 25;
const OCCUPIED_MIN = 65;
const FREE = 254;
const OCCUPIED = 0;
const UNKNOWN = 205;

export interface MapFiles {
  readonly pgm: Blob;
  readonly yaml: Blob;
}

/** Picture and description of a map, for files NAME.pgm and NAME.yaml; a sentence if the message is no valid map. */
export function mapFiles(name: string, grid: OccupancyGrid): MapFiles | string {
  const map = readMap(grid);
  if (typeof map === "string") return map;
  const { width, height, resolution, cells } = map;
  const pixels = new Uint8Array(width * height);
  for (let row = 0; row < height; row++) {
    const from = (height - 1 - row) * width; // a picture's first row is its top
    for (let column = 0; column < width; column++) pixels[row * width + column] = shade(cells[from + column] ?? 255);
  }
  const head = `P5\n# made by Trundle, ${resolution.toFixed(3)} m/pixel\n${width} ${height}\n255\n`;
  const { position, orientation } = grid.info.origin;
  const origin = [position.x, position.y, yawOf(orientation)].map((value) => value.toFixed(6)).join(", ");
  const yaml =
    `image: ${name}.pgm\nresolution: ${resolution.toFixed(6)}\norigin: [${origin}]\n` +
    "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  return {
    pgm: new Blob([head, pixels], { type: "image/x-portable-graymap" }),
    yaml: new Blob([yaml], { type: "application/yaml" }),
  };
}

function shade(cell: number): number {
  if (cell <= FREE_MAX) return FREE;
  return cell >= OCCUPIED_MIN && cell <= 100 ? OCCUPIED : UNKNOWN;
}

/** Rotation about z [rad]. */
export function yawOf({ x, y, z, w }: Quaternion): number {
  return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}
