/** Lines a pixel wide, as rviz's simple lines. */

import { BufferAttribute, BufferGeometry, Line, LineSegments } from "three";

import type { Rgb } from "../rviz/properties";
import { flatMaterial, type ShapeMaterial } from "./shape_material";

/** A line through points, three numbers each [m]. */
export class PixelLine extends Line<BufferGeometry, ShapeMaterial> {
  constructor(points: Float32Array, color: Rgb, alpha = 1) {
    super(geometryOf(points), flatMaterial());
    this.material.setColor(color, alpha);
  }
  override dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
  }
}

/** Lines between pairs of points, three numbers each [m]. */
export class PixelSegments extends LineSegments<BufferGeometry, ShapeMaterial> {
  constructor(points: Float32Array, color: Rgb, alpha = 1) {
    super(geometryOf(points), flatMaterial());
    this.material.setColor(color, alpha);
  }
  override dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
  }
}

function geometryOf(points: Float32Array): BufferGeometry {
  return new BufferGeometry().setAttribute("position", new BufferAttribute(points, 3));
}
