/** rviz/Pose: an arrow or axes at a pose. */

import { Group, type Object3D } from "three";

import type { PoseStamped } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { PoseShape } from "./pose_shape";
import { register } from "./registry";
import { INVALID_FLOATS, isFinitePose, placed } from "../frames/valid";

const TYPES = ["geometry_msgs/PoseStamped"];

class PoseDisplay extends HistoryDisplay<PoseStamped> {
  readonly className = "rviz/Pose";
  private readonly shape = new PoseShape();

  constructor(context: DisplayContext) {
    super(context, TYPES);
    this.properties.push(this.shape.shape, ...this.shape.details);
  }

  protected override fault({ pose }: PoseStamped): string | null {
    return isFinitePose(pose) ? null : INVALID_FLOATS;
  }

  protected draw({ pose }: PoseStamped): Object3D {
    return new Group().add(placed(this.shape.draw(), pose));
  }

  protected override describe({ pose }: PoseStamped): Readonly<Record<string, unknown>> {
    return { Position: pose.position, Orientation: pose.orientation };
  }
}

register({ className: "rviz/Pose", aliases: [], types: TYPES, create: (context) => new PoseDisplay(context) });
