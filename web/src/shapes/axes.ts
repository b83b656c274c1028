/** Three axes, x red, y green, z blue. */

import { Group, Mesh } from "three";

import type { Rgb } from "../rviz/properties";
import { ShapeMaterial } from "./shape_material";
import { SHAFT } from "./solids";

/** Colors of x, y and z. */
export type AxisColors = readonly [Rgb, Rgb, Rgb];

/** rviz's colors. */
export const AXIS_RGB: AxisColors = [
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
    this.setColors(AXIS_RGB, 1);
  }

  /** Length and rviz's radius [m], which is the diameter of its cylinders. */
  setSize(length: number, radius: number): void {
    for (const axis of this.axes) axis.scale.set(length, radius, radius);
  }

  setColors(colors: AxisColors, alpha: number): void {
    this.axes.forEach((axis, index) => axis.material.setColor(colors[index] ?? [255, 255, 255], alpha));
  }

  override dispose(): void {
    for (const axis of this.axes) axis.material.dispose();
  }
}
