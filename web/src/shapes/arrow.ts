/** An arrow along x: a shaft and a head with a color each. */

import { Group, Mesh } from "three";

import type { Rgb } from "../rviz/properties";
import { ShapeMaterial } from "./shape_material";
import { HEAD, SHAFT, type ArrowProportions } from "./solids";

export class Arrow extends Group {
  private readonly shaftMaterial = new ShapeMaterial();
  private readonly headMaterial = new ShapeMaterial();
  private readonly shaft = new Mesh(SHAFT, this.shaftMaterial);
  private readonly head = new Mesh(HEAD, this.headMaterial);

  constructor(
    proportions: ArrowProportions = { shaftLength: 1, shaftDiameter: 0.1, headLength: 0.3, headDiameter: 0.2 },
  ) {
    super();
    super.add(this.shaft, this.head);
    this.setProportions(proportions);
  }

  setProportions({ shaftLength, shaftDiameter, headLength, headDiameter }: ArrowProportions): void {
    this.shaft.scale.set(shaftLength, shaftDiameter, shaftDiameter);
    this.head.scale.set(headLength, headDiameter, headDiameter);
    this.head.position.x = shaftLength;
    this.shaft.visible = shaftLength > 0;
    this.head.visible = headLength > 0;
  }

  setColor(color: Rgb, alpha = 1): void {
    this.shaftMaterial.setColor(color, alpha);
    this.headMaterial.setColor(color, alpha);
  }

  setShaftColor(color: Rgb, alpha = 1): void {
    this.shaftMaterial.setColor(color, alpha);
  }

  setHeadColor(color: Rgb, alpha = 1): void {
    this.headMaterial.setColor(color, alpha);
  }

  override dispose(): void {
    this.shaftMaterial.dispose();
    this.headMaterial.dispose();
  }
}
