/** One of the shared solids in a color of its own. */

import { Mesh, type BufferGeometry } from "three";

import type { Rgb } from "../rviz/properties";
import { ShapeMaterial } from "./shape_material";

export class Solid extends Mesh<BufferGeometry, ShapeMaterial> {
  constructor(geometry: BufferGeometry, color: Rgb, alpha = 1) {
    super(geometry, new ShapeMaterial());
    this.material.setColor(color, alpha);
  }

  override dispose(): void {
    this.material.dispose();
  }
}
