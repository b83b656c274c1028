/** rviz/Range: a cone from the sensor, as long as the measured range. */

import { Group, type Object3D } from "three";

import type { Range } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { ColorProperty, IntProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";
import { Solid } from "../shapes/solid";
import { HEAD } from "../shapes/solids";
import { areFinite, INVALID_FLOATS } from "../frames/valid";

const TYPES = ["sensor_msgs/Range"];

class RangeDisplay extends HistoryDisplay<Range> {
  readonly className = "rviz/Range";
  private readonly color = this.add(new ColorProperty("Color", [255, 255, 255]));
  private readonly alpha = this.add(new NumberProperty("Alpha", 0.5, { min: 0, max: 1 }));
  private readonly bufferLength = this.add(
    new IntProperty("Buffer Length", 1, { min: 1, description: "Number of prior measurements to display." }),
  );

  constructor(context: DisplayContext) {
    super(context, TYPES);
  }

  protected override capacity(): number {
    return this.bufferLength.value.peek();
  }

  protected override fault({ field_of_view, min_range, max_range }: Range): string | null {
    return areFinite([field_of_view, min_range]) && !Number.isNaN(max_range) ? null : INVALID_FLOATS;
  }

  protected draw(message: Range): Object3D {
    const range = displayedRange(message);
    const width = 2 * range * Math.tan(message.field_of_view / 2);
    const group = new Group();
    if (!(range > 0) || width === 0) return group;
    const cone = new Solid(HEAD, this.color.value.peek(), this.alpha.value.peek());
    cone.scale.set(range, width, width);
    cone.rotation.set(0, 0, Math.PI);
    cone.position.x = range; // the tip is at the sensor
    return group.add(cone);
  }

  protected override describe({
    range,
    min_range,
    max_range,
    field_of_view,
  }: Range): Readonly<Record<string, unknown>> {
    return { Range: range, "Min Range": min_range, "Max Range": max_range, "Field of View": field_of_view };
  }
}

/**
 * Length of the cone [m]: the range if it is within its limits; a fixed-distance ranger reports −Inf for a detection.
 */
export function displayedRange({ range, min_range, max_range }: Range): number {
  if (min_range <= range && range <= max_range) return Number.isFinite(range) ? range : 0;
  return min_range === max_range && range === -Infinity ? min_range : 0;
}

register({ className: "rviz/Range", aliases: [], types: TYPES, create: (context) => new RangeDisplay(context) });
