/** Lines that plugins draw and rays of lidars, from `trundle/lines` and `trundle/ranges`. */

import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  Points,
  PointsMaterial,
  SRGBColorSpace,
} from "three";

import { NOT_PICKED } from "../picking";

const HEADER = 12;
const [STRIP, POINTS] = [0, 2];
/** Width of a point [px]. */
const POINT = 4;
/** Types of three.js, by the kinds of the wire: strip, pairs, points. */
const TYPES = ["Line", "LineSegments", "Points"];

interface ReadLine {
  readonly id: string;
  readonly rgba: readonly [number, number, number, number];
  readonly kind: number;
  readonly points: Float32Array;
}

/** Lines of a message; null: truncated. */
export function readLines(message: DataView): ReadLine[] | null {
  const lines: ReadLine[] = [];
  const decoder = new TextDecoder();
  try {
    let at = HEADER;
    for (let left = message.getUint32(8, true); left > 0; left -= 1) {
      const length = message.getUint32(at, true);
      const id = decoder.decode(new Uint8Array(message.buffer, message.byteOffset + at + 4, length));
      at += 4 + length;
      const byte = (i: number): number => message.getUint8(at + i) / 255;
      const rgba = [byte(0), byte(1), byte(2), byte(3)] as const;
      const kind = message.getUint32(at + 4, true);
      if (kind > POINTS) return null;
      const points = new Float32Array(3 * message.getUint32(at + 8, true));
      at += 12;
      for (let i = 0; i < points.length; i += 1, at += 4) points[i] = message.getFloat32(at, true);
      lines.push({ id, rgba, kind, points });
    }
  } catch (error) {
    if (error instanceof RangeError) return null;
    throw error;
  }
  return lines;
}

type Drawn = Line<BufferGeometry, LineBasicMaterial> | Points<BufferGeometry, PointsMaterial>;

export class WorldLines extends Group {
  private readonly drawn = new Map<string, Drawn>();

  constructor() {
    super();
    this.userData[NOT_PICKED] = true;
  }

  /** Replace the lines by those of a message. */
  show(lines: readonly ReadLine[]): void {
    const removed = new Set(this.drawn.keys());
    for (const line of lines) {
      removed.delete(line.id);
      this.draw(line);
    }
    for (const id of removed) this.drop(id);
  }

  private draw({ id, rgba: [red, green, blue, alpha], kind, points }: ReadLine): void {
    let drawn = this.drawn.get(id);
    if (drawn !== undefined && drawn.type !== TYPES[kind]) {
      this.drop(id);
      drawn = undefined;
    }
    if (drawn === undefined) {
      drawn = create(kind);
      drawn.frustumCulled = false;
      this.drawn.set(id, drawn);
      this.add(drawn);
    }
    setPoints(drawn.geometry, points);
    drawn.material.color.setRGB(red, green, blue, SRGBColorSpace);
    drawn.material.opacity = alpha;
    if (drawn.material.transparent !== alpha < 1) drawn.material.needsUpdate = true; // opaque and blended materials have different programs
    drawn.material.transparent = alpha < 1;
  }

  private drop(id: string): void {
    const drawn = this.drawn.get(id);
    if (drawn === undefined) return;
    this.drawn.delete(id);
    this.remove(drawn);
    drawn.geometry.dispose();
    drawn.material.dispose();
  }
}

function create(kind: number): Drawn {
  const geometry = new BufferGeometry();
  if (kind === POINTS) return new Points(geometry, new PointsMaterial({ size: POINT, sizeAttenuation: false }));
  const material = new LineBasicMaterial();
  return kind === STRIP ? new Line(geometry, material) : new LineSegments(geometry, material);
}

/** Write points into the existing buffer, if they fit. */
function setPoints(geometry: BufferGeometry, points: Float32Array): void {
  const old = geometry.hasAttribute("position") ? geometry.getAttribute("position") : null;
  if (old instanceof BufferAttribute && old.array.length >= points.length) {
    old.array.set(points);
    old.needsUpdate = true;
  } else {
    geometry.dispose();
    geometry.setAttribute("position", new BufferAttribute(points, 3).setUsage(DynamicDrawUsage));
  }
  geometry.setDrawRange(0, points.length / 3);
}
