/** rviz/Odometry: arrows or axes along the path, one for each motion beyond the tolerance. */

import { Group, type Object3D } from "three";

import type { Transform } from "../frames/transform";
import type { Odometry, Pose } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { PoseShape } from "./pose_shape";
import { IntProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";
import { CovarianceProperty, CovarianceVisual } from "../shapes/covariance";
import { areFinite, INVALID_FLOATS, isFinitePose, isFiniteXyz, placed, quaternion, vector } from "../frames/valid";

const TYPES = ["nav_msgs/Odometry"];
/** Longest history where rviz has no limit [messages]. */
const MAX_LENGTH = 10_000;

class OdometryDisplay extends HistoryDisplay<Odometry> {
  readonly className = "rviz/Odometry";
  private readonly positionTolerance = this.add(new NumberProperty("Position Tolerance", 0.1, { min: 0, unit: "m" }));
  private readonly angleTolerance = this.add(new NumberProperty("Angle Tolerance", 0.1, { min: 0, unit: "rad" }));
  private readonly keep = this.add(
    new IntProperty("Keep", 100, { min: 0, description: "Arrows that are shown; 0 keeps them all." }),
  );
  private readonly shape = new PoseShape();
  private readonly covariance = new CovarianceProperty();
  private last: Pose | null = null;

  constructor(context: DisplayContext) {
    super(context, TYPES);
    for (const detail of this.shape.details) this.shape.shape.add(detail);
    this.properties.push(this.shape.shape, this.covariance);
  }

  protected override capacity(): number {
    return this.keep.value.peek() === 0 ? MAX_LENGTH : this.keep.value.peek();
  }

  protected override fault({ pose: { pose, covariance }, twist }: Odometry): string | null {
    const isValid =
      isFinitePose(pose) &&
      areFinite(covariance) &&
      isFiniteXyz(twist.twist.linear) &&
      isFiniteXyz(twist.twist.angular);
    return isValid ? null : INVALID_FLOATS;
  }

  protected override process(message: Odometry, transform: Transform): void {
    const { pose } = message.pose;
    if (this.last !== null && this.isNear(this.last, pose)) return;
    this.last = pose;
    super.process(message, transform);
  }

  protected override clear(): void {
    super.clear();
    this.last = null;
  }

  protected draw({ pose: { pose, covariance } }: Odometry): Object3D {
    const group = new Group().add(placed(this.shape.draw(), pose));
    if (!this.covariance.value.peek()) return group;
    const visual = new CovarianceVisual(this.covariance);
    visual.setCovariance(covariance, quaternion(pose.orientation));
    visual.position.copy(vector(pose.position));
    return group.add(visual);
  }

  protected override describe({ child_frame_id, pose, twist }: Odometry): Readonly<Record<string, unknown>> {
    return {
      "Child Frame": child_frame_id,
      Position: pose.pose.position,
      Orientation: pose.pose.orientation,
      Twist: twist.twist,
    };
  }

  private isNear(last: Pose, pose: Pose): boolean {
    const distance = vector(last.position).distanceTo(vector(pose.position));
    const angle = quaternion(last.orientation).angleTo(quaternion(pose.orientation));
    return distance < this.positionTolerance.value.peek() && angle < this.angleTolerance.value.peek();
  }
}

register({ className: "rviz/Odometry", aliases: [], types: TYPES, create: (context) => new OdometryDisplay(context) });
