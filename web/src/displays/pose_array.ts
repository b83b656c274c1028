/** rviz/PoseArray: many poses, as a particle filter's. */

import { computed } from "@preact/signals";
import { Group, Vector3, type Object3D } from "three";

import type { Pose, PoseArray } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { ColorProperty, EnumProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";
import { PixelSegments } from "../shapes/lines";
import { arrowsAt, axesAt } from "../shapes/pose_instances";
import { INVALID_FLOATS, isFinitePose, quaternion, vector } from "../frames/valid";

const TYPES = ["geometry_msgs/PoseArray"];
const FLAT = "Arrow (Flat)";
const SOLID = "Arrow (3D)";
const AXES = "Axes";
/** rviz's flat arrow: pairs of points, in lengths of the arrow. */
const FLAT_ARROW = [
  [0, 0],
  [1, 0],
  [1, 0],
  [0.75, 0.2],
  [1, 0],
  [0.75, -0.2],
] as const;

class PoseArrayDisplay extends HistoryDisplay<PoseArray> {
  readonly className = "rviz/PoseArray";
  private readonly shape = this.add(new EnumProperty("Shape", FLAT, [FLAT, SOLID, AXES]));
  private readonly color = this.add(
    new ColorProperty("Color", [255, 25, 0], { visible: computed(() => this.shape.value.value !== AXES) }),
  );
  private readonly alpha = this.add(
    new NumberProperty("Alpha", 1, { min: 0, max: 1, visible: computed(() => this.shape.value.value !== AXES) }),
  );
  private readonly arrowLength = this.length("Arrow Length", 0.3, FLAT);
  private readonly headRadius = this.length("Head Radius", 0.03, SOLID);
  private readonly headLength = this.length("Head Length", 0.07, SOLID);
  private readonly shaftRadius = this.length("Shaft Radius", 0.01, SOLID);
  private readonly shaftLength = this.length("Shaft Length", 0.23, SOLID);
  private readonly axesLength = this.length("Axes Length", 0.3, AXES);
  private readonly axesRadius = this.length("Axes Radius", 0.01, AXES);

  constructor(context: DisplayContext) {
    super(context, TYPES);
  }

  protected override fault({ poses }: PoseArray): string | null {
    return poses.every(isFinitePose) ? null : INVALID_FLOATS;
  }

  protected draw({ poses }: PoseArray): Object3D {
    return new Group().add(this.drawShapes(poses));
  }

  private drawShapes(poses: readonly Pose[]): Object3D {
    const [color, alpha] = [this.color.value.peek(), this.alpha.value.peek()];
    switch (this.shape.value.peek()) {
      case SOLID: {
        const proportions = {
          shaftLength: this.shaftLength.value.peek(),
          shaftDiameter: this.shaftRadius.value.peek(),
          headLength: this.headLength.value.peek(),
          headDiameter: this.headRadius.value.peek(),
        };
        return arrowsAt(poses, proportions, color, alpha);
      }
      case AXES:
        return axesAt(poses, this.axesLength.value.peek(), this.axesRadius.value.peek());
      default:
        return new PixelSegments(flatArrows(poses, this.arrowLength.value.peek()), color, alpha);
    }
  }

  protected override describe({ poses }: PoseArray): Readonly<Record<string, unknown>> {
    return { Poses: poses.length };
  }

  private length(name: string, initial: number, shape: string): NumberProperty {
    return this.add(
      new NumberProperty(name, initial, { unit: "m", visible: computed(() => this.shape.value.value === shape) }),
    );
  }
}

/** Points of the lines of flat arrows of a length [m], three numbers each. */
export function flatArrows(poses: readonly Pose[], length: number): Float32Array {
  const points = new Float32Array(poses.length * FLAT_ARROW.length * 3);
  const point = new Vector3();
  poses.forEach((pose, index) => {
    const [position, orientation] = [vector(pose.position), quaternion(pose.orientation)];
    FLAT_ARROW.forEach(([x, y], corner) => {
      point
        .set(x * length, y * length, 0)
        .applyQuaternion(orientation)
        .add(position);
      point.toArray(points, (index * FLAT_ARROW.length + corner) * 3);
    });
  });
  return points;
}

register({
  className: "rviz/PoseArray",
  aliases: [],
  types: TYPES,
  create: (context) => new PoseArrayDisplay(context),
});
