/** rviz/PointStamped: a sphere at a point. */

import { Group, type Object3D } from "three";

import type { PointStamped } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { ColorProperty, IntProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";
import { Solid } from "../shapes/solid";
import { SPHERE } from "../shapes/solids";
import { INVALID_FLOATS, isFiniteXyz, vector } from "../frames/valid";

const TYPES = ["geometry_msgs/PointStamped"];

class PointStampedDisplay extends HistoryDisplay<PointStamped> {
  readonly className = "rviz/PointStamped";
  private readonly color = this.add(new ColorProperty("Color", [204, 41, 204]));
  private readonly alpha = this.add(new NumberProperty("Alpha", 1, { min: 0, max: 1 }));
  private readonly radius = this.add(new NumberProperty("Radius", 0.2, { unit: "m" }));
  private readonly historyLength = this.add(
    new IntProperty("History Length", 1, {
      min: 1,
      max: 100000,
      description: "Number of prior measurements to display.",
    }),
  );

  constructor(context: DisplayContext) {
    super(context, TYPES);
  }

  protected override capacity(): number {
    return this.historyLength.value.peek();
  }

  protected override fault({ point }: PointStamped): string | null {
    return isFiniteXyz(point) ? null : INVALID_FLOATS;
  }

  protected draw({ point }: PointStamped): Object3D {
    const sphere = new Solid(SPHERE, this.color.value.peek(), this.alpha.value.peek());
    sphere.scale.setScalar(2 * this.radius.value.peek());
    sphere.position.copy(vector(point));
    return new Group().add(sphere);
  }

  protected override describe({ point }: PointStamped): Readonly<Record<string, unknown>> {
    return { Position: point };
  }
}

register({
  className: "rviz/PointStamped",
  aliases: [],
  types: TYPES,
  create: (context) => new PointStampedDisplay(context),
});
