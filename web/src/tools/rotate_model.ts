/** Turns the selection by rings about its axes. */

import { Vector3 } from "three";

import { BoolProperty, EnumProperty, NumberProperty } from "../rviz/properties";
import type { Transform } from "../frames/transform";
import { HandleTool } from "./handle_tool";
import type { Handle } from "./handles/selection_handles";
import { snapToAngle } from "./handles/snapping";
import type { PointerInput } from "../scene/pointer_input";

const DEGREE = Math.PI / 180;

export class RotateModel extends HandleTool {
  readonly className = "trundle/Rotate";
  readonly name = "Rotate";
  readonly shortcut = "r";
  readonly icon = "rotate";
  readonly snaps = this.add(new BoolProperty("Snap", false, { description: "Always, not only with Ctrl" }));
  readonly step = this.add(new NumberProperty("Step", 15, { min: 0.1, max: 180, unit: "°" }));
  protected readonly axes = this.add(new EnumProperty("Axes", "Model", ["World", "Model"]));
  protected readonly usage = "Drag a ring. Ctrl: snap to steps.";
  protected readonly body = null;
  private readonly all: readonly Handle[] = [
    { kind: "ring", axis: new Vector3(1, 0, 0), letter: 0 },
    { kind: "ring", axis: new Vector3(0, 1, 0), letter: 1 },
    { kind: "ring", axis: new Vector3(0, 0, 1), letter: 2 },
  ];

  protected handlesOf(): readonly Handle[] {
    return this.all;
  }

  protected snap(to: Transform, from: Transform, { control }: PointerInput): void {
    if (control || this.snaps.value.peek()) snapToAngle(to, from, this.step.value.peek() * DEGREE);
  }

  protected standsOnSurface(): boolean {
    return false;
  }

  protected describe(to: Transform, from: Transform): string {
    return `Turned by ${(to.orientation.angleTo(from.orientation) / DEGREE).toFixed(1)}°`;
  }
}
