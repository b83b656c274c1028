/** Cells of a map with all updates since its message. */

import type { OccupancyGrid, OccupancyGridUpdate } from "../../protocol/generated/ros_messages";
import { INVALID_FLOATS, isFinitePose } from "../../frames/valid";

/** Most cells of a map that is shown: 16384 × 16384. */
const MAX_CELLS = 2 ** 28;
const UNKNOWN = 255;

export interface OccupancyMap {
  readonly width: number;
  readonly height: number;
  /** [m] of a cell. */
  readonly resolution: number;
  /** A byte for each cell, by rows from the origin; −1 is 255. */
  readonly cells: Uint8Array;
  /** rviz's sentence about a message whose data has another size; null: it fits. */
  readonly fault: string | null;
}

/** A rectangle of cells. */
export interface Region {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Map of a message, or rviz's error. Cells are the message's own bytes if their size fits. */
export function readMap({ info, data }: OccupancyGrid): OccupancyMap | string {
  const { width, height, resolution, origin } = info;
  if (!Number.isFinite(resolution) || !isFinitePose(origin)) return INVALID_FLOATS;
  const count = width * height;
  if (count === 0) return `Map is zero-sized (${width}x${height})`;
  const bytes = new Uint8Array(data.buffer, data.byteOffset, data.length);
  if (count === data.length && count <= MAX_CELLS) return { width, height, resolution, cells: bytes, fault: null };
  const fault = `Data size doesn't match width*height: width = ${width}, height = ${height}, data size = ${data.length}`;
  if (count > Math.min(MAX_CELLS, 4 * data.length + 4096)) return fault; // too few cells for that much memory
  const cells = new Uint8Array(count).fill(UNKNOWN);
  cells.set(bytes.subarray(0, count));
  return { width, height, resolution, cells, fault };
}

/** Write an update into a map; returns its region, or rviz's sentence. */
export function writeUpdate(map: OccupancyMap, { x, y, width, height, data }: OccupancyGridUpdate): Region | string {
  if (x < 0 || y < 0 || x + width > map.width || y + height > map.height)
    return "Update area outside of original map area.";
  if (width * height !== data.length) return `Update of ${width} x ${height} cells has ${data.length} bytes.`;
  for (let row = 0; row < height; row++) {
    const from = new Uint8Array(data.buffer, data.byteOffset + row * width, width);
    map.cells.set(from, (y + row) * map.width + x);
  }
  return { x, y, width, height };
}

/** Bytes of a region, by rows; for a region that is the whole map, the map's own array. */
export function cut(map: OccupancyMap, { x, y, width, height }: Region): Uint8Array<ArrayBuffer> {
  if (width === map.width && height === map.height && map.cells.buffer instanceof ArrayBuffer)
    return map.cells as Uint8Array<ArrayBuffer>;
  const bytes = new Uint8Array(width * height);
  for (let row = 0; row < height; row++) {
    const from = (y + row) * map.width + x;
    bytes.set(map.cells.subarray(from, from + width), row * width);
  }
  return bytes;
}

/** Tiles of `size` × `size` cells that a map is drawn in. */
export function tilesOf({ width, height }: OccupancyMap, size: number): Region[] {
  const tiles: Region[] = [];
  for (let y = 0; y < height; y += size) {
    for (let x = 0; x < width; x += size)
      tiles.push({ x, y, width: Math.min(size, width - x), height: Math.min(size, height - y) });
  }
  return tiles;
}

export function overlap(a: Region, b: Region): Region | null {
  const x = Math.max(a.x, b.x);
  const y = Math.max(a.y, b.y);
  const width = Math.min(a.x + a.width, b.x + b.width) - x;
  const height = Math.min(a.y + a.height, b.y + b.height) - y;
  return width > 0 && height > 0 ? { x, y, width, height } : null;
}
