/** Path of a point of the fixed frame, as a ribbon. */

import { Vector3 } from "three";

import { BillboardLines } from "./billboard_lines";

/** Smallest distance between kept points [m], and their largest number. */
const SPACING = 0.05;
const MAX_POINTS = 1000;
const RGBA = [0, 0.5, 0.5, 1] as const;

export class Trail extends BillboardLines {
  private points: number[] = [];
  private readonly last = new Vector3(NaN, NaN, NaN);

  constructor() {
    super(0.01);
  }

  /** Add the point's current position [m]. */
  follow(position: Vector3): void {
    if (position.distanceTo(this.last) < SPACING) return;
    this.last.copy(position);
    this.points.push(position.x, position.y, position.z);
    if (this.points.length > 3 * MAX_POINTS) this.points = this.points.slice(-3 * MAX_POINTS);
    this.begin();
    this.addPolyline(this.points, RGBA);
    this.finish();
  }
}
