/** Moves the selection by arrows, squares and a ring, or by a drag of itself over the ground. */

import { Vector3 } from "three";

import { BoolProperty, EnumProperty, NumberProperty } from "../rviz/properties";
import type { Transform } from "../frames/transform";
import { HandleTool } from "./handle_tool";
import type { Handle } from "./handles/selection_handles";
import { snapToAngle, snapToGrid } from "./handles/snapping";
import type { PointerInput } from "../scene/pointer_input";

const AXES = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)] as const;
const LETTERS = [0, 1, 2] as const;
const ANGLE = Math.PI / 12;

export class MoveModel extends HandleTool {
  readonly className = "trundle/Move";
  readonly name = "Move";
  readonly shortcut = "t";
  readonly icon = "move";
  readonly snaps = this.add(new BoolProperty("Snap to Grid", false, { description: "Always, not only with Ctrl" }));
  readonly cell = this.add(new NumberProperty("Grid", 0.1, { min: 0.001, max: 100, unit: "m" }));
  readonly stands = this.add(
    new BoolProperty("Snap to Surfaces", false, {
      description: "Place on the surface under the pointer, not only with Shift",
    }),
  );
  protected readonly axes = this.add(new EnumProperty("Axes", "World", ["World", "Model"]));
  protected readonly usage =
    "Drag an arrow, or the model over the ground. Ctrl: snap to the grid. Shift: snap to surfaces.";
  protected readonly body: Handle = { kind: "plane", axis: AXES[2] };
  private readonly all: readonly Handle[] = [
    ...LETTERS.map((letter): Handle => ({ kind: "axis", axis: AXES[letter], letter })),
    ...LETTERS.map((letter): Handle => ({ kind: "plane", axis: AXES[letter], letter })),
    { kind: "ring", axis: AXES[2], letter: 2 },
    { kind: "free", axis: AXES[2] },
  ];

  protected handlesOf(): readonly Handle[] {
    return this.all;
  }

  protected snap(to: Transform, from: Transform, { control }: PointerInput): void {
    if (!control && !this.snaps.value.peek()) return;
    snapToGrid(to, from, this.cell.value.peek());
    snapToAngle(to, from, ANGLE);
  }

  protected standsOnSurface({ shift }: PointerInput, { kind }: Handle): boolean {
    return (kind === "free" || kind === "plane") && (shift || this.stands.value.peek());
  }

  protected describe({ position: { x, y, z } }: Transform): string {
    return `x ${x.toFixed(3)} m, y ${y.toFixed(3)} m, z ${z.toFixed(3)} m`.replace(/-/g, "−");
  }
}
