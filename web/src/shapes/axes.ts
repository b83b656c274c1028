/** Three axes, x red, y green, z blue. */

import { Group, Mesh } from "three";

import type { Rgb } from "../rviz/properties";
import { ShapeMaterial } from "./shape_material";
import { SHAFT } from "./solids";

export const AXIS_RGB: readonly [Rgb, Rgb, Rgb] = [
  [255, 0, 0],
  [0, 255, 0],
  [0, 0, 255],
];

export class Axes extends Group {
  private readonly axes = AXIS_RGB.map(() => new Mesh(SHAFT, new ShapeMaterial()));

  constructor(length = 1, radius = 0.1) {
    super();
    const [, y, z] = this.axes;
    y?.rotation.set(0, 0, Math.PI / 2);
    z?.rotation.set(0, -Math.PI / 2, 0);
    super.add(...this.axes);
    this.setSize(length, radius);
    this.setAlpha(1);
  }

  /** Length and rviz's radius [m], which is the diameter of its cylinders. */
  setSize(length: number, radius: number): void {
    for (const axis of this.axes) axis.scale.set(length, radius, radius);
  }

  setAlpha(alpha: number): void {
    this.axes.forEach((axis, index) => axis.material.setColor(AXIS_RGB[index] ?? [255, 255, 255], alpha));
  }

  /** Mix the axes' colors with grey: 0: no grey, 1: grey (0.7). */
  setFaded(share: number, alpha: number): void {
    this.axes.forEach((axis, index) => {
      const [red, green, blue] = AXIS_RGB[index] ?? [255, 255, 255];
      const mix = (part: number): number => (part / 255) * (1 - share) + 0.7 * share;
      axis.material.setRgba(mix(red), mix(green), mix(blue), alpha);
    });
  }

  override dispose(): void {
    for (const axis of this.axes) axis.material.dispose();
  }
}
