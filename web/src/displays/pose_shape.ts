/** Properties of an arrow or axes that show a pose, and the shape itself. */

import { computed } from "@preact/signals";
import type { Object3D } from "three";

import { ColorProperty, EnumProperty, NumberProperty, type Property } from "../rviz/properties";
import { Arrow } from "../shapes/arrow";
import { Axes } from "../shapes/axes";

export class PoseShape {
  readonly shape = new EnumProperty("Shape", "Arrow", ["Arrow", "Axes"]);
  private readonly isArrow = computed(() => this.shape.value.value === "Arrow");
  private readonly isAxes = computed(() => !this.isArrow.value);
  readonly color = new ColorProperty("Color", [255, 25, 0], { visible: this.isArrow });
  readonly alpha = new NumberProperty("Alpha", 1, { min: 0, max: 1, visible: this.isArrow });
  private readonly shaftLength = this.length("Shaft Length", 1);
  private readonly shaftRadius = this.length("Shaft Radius", 0.05);
  private readonly headLength = this.length("Head Length", 0.3);
  private readonly headRadius = this.length("Head Radius", 0.1);
  private readonly axesLength = new NumberProperty("Axes Length", 1, { unit: "m", visible: this.isAxes });
  private readonly axesRadius = new NumberProperty("Axes Radius", 0.1, { unit: "m", visible: this.isAxes });

  /** Properties of the shape, in rviz's order. */
  get details(): readonly Property<unknown>[] {
    const { color, alpha, shaftLength, shaftRadius, headLength, headRadius, axesLength, axesRadius } = this;
    return [color, alpha, shaftLength, shaftRadius, headLength, headRadius, axesLength, axesRadius];
  }

  /** Draw along x from the origin. rviz draws with its radii as diameters. */
  draw(): Object3D {
    if (this.isAxes.peek()) return new Axes(this.axesLength.value.peek(), this.axesRadius.value.peek());
    const arrow = new Arrow({
      shaftLength: this.shaftLength.value.peek(),
      shaftDiameter: this.shaftRadius.value.peek(),
      headLength: this.headLength.value.peek(),
      headDiameter: this.headRadius.value.peek(),
    });
    arrow.setColor(this.color.value.peek(), this.alpha.value.peek());
    return arrow;
  }

  private length(name: string, initial: number): NumberProperty {
    return new NumberProperty(name, initial, { unit: "m", visible: this.isArrow });
  }
}
