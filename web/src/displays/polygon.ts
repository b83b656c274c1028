/** rviz/Polygon: a closed line. */

import { Group, type Object3D } from "three";

import type { PolygonStamped } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { ColorProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";
import { PixelLine } from "../shapes/lines";
import { INVALID_FLOATS, isFiniteXyz } from "../frames/valid";

const TYPES = ["geometry_msgs/PolygonStamped"];

class PolygonDisplay extends HistoryDisplay<PolygonStamped> {
  readonly className = "rviz/Polygon";
  private readonly color = this.add(new ColorProperty("Color", [25, 255, 0]));
  private readonly alpha = this.add(new NumberProperty("Alpha", 1, { min: 0, max: 1 }));

  constructor(context: DisplayContext) {
    super(context, TYPES);
  }

  protected override fault({ polygon }: PolygonStamped): string | null {
    return polygon.points.every(isFiniteXyz) ? null : INVALID_FLOATS;
  }

  protected draw({ polygon: { points } }: PolygonStamped): Object3D {
    const closed = [...points, ...points.slice(0, 1)].flatMap(({ x, y, z }) => [x, y, z]);
    return new Group().add(new PixelLine(Float32Array.from(closed), this.color.value.peek(), this.alpha.value.peek()));
  }

  protected override describe({ polygon }: PolygonStamped): Readonly<Record<string, unknown>> {
    return { Points: polygon.points };
  }
}

register({ className: "rviz/Polygon", aliases: [], types: TYPES, create: (context) => new PolygonDisplay(context) });
