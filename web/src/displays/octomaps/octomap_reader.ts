/** Voxels of an octomap message, as octomap's own streams hold them. */

import type { Octomap } from "../../protocol/generated/ros_messages";

/** Levels of octomap's trees. */
const DEPTH = 16;
/** Bounds the memory of a damaged or huge message. */
const MAX_VOXELS = 2_000_000;
/** Log odds of a node that a binary stream calls occupied or free; octomap clamps to them. */
const OCCUPIED = 3.5;
const FREE = -2;

export interface Voxels {
  readonly count: number;
  /** x, y, z of each middle, and its size [m]. */
  readonly boxes: Float32Array;
  /** Probability of each that it is occupied, 0…1. */
  readonly probabilities: Float32Array;
  /** r, g, b of each, 0…1; empty: the tree has no colors. */
  readonly colors: Float32Array;
}

/** Leaves of the tree; a sentence if the message cannot be read. */
export function readOctomap({ binary, id, resolution, data }: Octomap): Voxels | string {
  if (id !== "OcTree" && id !== "ColorOcTree") return `An octomap of ${id === "" ? "no type" : id} is not read.`;
  if (!(resolution > 0)) return "The octomap's resolution is not above 0 m.";
  const reader = new Reader(data, resolution, id === "ColorOcTree");
  try {
    if (data.length > 0) reader.read(binary);
  } catch (error) {
    if (error instanceof RangeError) return `The octomap ends early, or has more than ${MAX_VOXELS} voxels.`;
    throw error;
  }
  return {
    count: reader.probabilities.length,
    boxes: Float32Array.from(reader.boxes),
    probabilities: Float32Array.from(reader.probabilities),
    colors: Float32Array.from(reader.colors),
  };
}

class Reader {
  readonly boxes: number[] = [];
  readonly probabilities: number[] = [];
  readonly colors: number[] = [];
  private offset = 0;
  private readonly view: DataView;
  private readonly size: number;

  constructor(
    data: Int8Array,
    resolution: number,
    private readonly isColored: boolean,
  ) {
    this.view = new DataView(data.buffer, data.byteOffset, data.byteLength);
    this.size = resolution * 2 ** DEPTH;
  }

  read(isBinary: boolean): void {
    if (isBinary) this.readBinary(0, 0, 0, this.size, DEPTH);
    else this.readFull(0, 0, 0, this.size, DEPTH);
  }

  /** Each node: log odds, color of colored trees, a bit for each child that there is; then those children. */
  private readFull(x: number, y: number, z: number, size: number, depth: number): void {
    const odds = this.view.getFloat32(this.offset, true);
    const children = this.view.getUint8(this.offset + (this.isColored ? 7 : 4));
    const colorAt = this.offset + 4;
    this.offset += this.isColored ? 8 : 5;
    if (children === 0) {
      this.add(x, y, z, size, odds);
      if (this.isColored) for (let i = 0; i < 3; i++) this.colors.push(this.view.getUint8(colorAt + i) / 255);
    } else if (depth === 0) throw new RangeError("a node below the leaves");
    for (let child = 0; child < 8; child++)
      if ((children & (1 << child)) !== 0) {
        const [cx, cy, cz] = middle(x, y, z, size, child);
        this.readFull(cx, cy, cz, size / 2, depth - 1);
      }
  }

  /** Each inner node: two bits for each child; 1: free, 2: occupied, 3: an inner node, which follows. */
  private readBinary(x: number, y: number, z: number, size: number, depth: number): void {
    if (depth === 0) throw new RangeError("a node below the leaves");
    const kinds = this.view.getUint16(this.offset, true);
    this.offset += 2;
    for (let child = 0; child < 8; child++) {
      const kind = (kinds >> (2 * child)) & 3;
      if (kind === 0) continue;
      const [cx, cy, cz] = middle(x, y, z, size, child);
      if (kind === 3) this.readBinary(cx, cy, cz, size / 2, depth - 1);
      else this.add(cx, cy, cz, size / 2, kind === 2 ? OCCUPIED : FREE);
    }
  }

  private add(x: number, y: number, z: number, size: number, odds: number): void {
    if (this.probabilities.length >= MAX_VOXELS) throw new RangeError("too many voxels");
    this.boxes.push(x, y, z, size);
    this.probabilities.push(1 - 1 / (1 + Math.exp(odds)));
  }
}

/** Middle of a child: its number's bits are the sides along x, y, z. */
function middle(x: number, y: number, z: number, size: number, child: number): readonly [number, number, number] {
  const step = size / 4;
  const side = (bit: number): number => ((child & bit) === 0 ? -step : step);
  return [x + side(1), y + side(2), z + side(4)];
}
