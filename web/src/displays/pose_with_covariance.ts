/** rviz/PoseWithCovariance: an arrow or axes at a pose, with its covariance. */

import { Group, type Object3D } from "three";

import type { PoseWithCovarianceStamped } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { PoseShape } from "./pose_shape";
import { register } from "./registry";
import { CovarianceProperty, CovarianceVisual } from "../shapes/covariance";
import { areFinite, INVALID_FLOATS, isFinitePose, placed, quaternion, vector } from "../frames/valid";

const TYPES = ["geometry_msgs/PoseWithCovarianceStamped"];

class PoseWithCovarianceDisplay extends HistoryDisplay<PoseWithCovarianceStamped> {
  readonly className = "rviz/PoseWithCovariance";
  private readonly shape = new PoseShape();
  private readonly covariance = new CovarianceProperty();

  constructor(context: DisplayContext) {
    super(context, TYPES);
    this.properties.push(this.shape.shape, ...this.shape.details, this.covariance);
  }

  protected override fault({ pose: { pose, covariance } }: PoseWithCovarianceStamped): string | null {
    return isFinitePose(pose) && areFinite(covariance) ? null : INVALID_FLOATS;
  }

  protected draw({ pose: { pose, covariance } }: PoseWithCovarianceStamped): Object3D {
    const visual = new CovarianceVisual(this.covariance);
    visual.setCovariance(covariance, quaternion(pose.orientation));
    visual.position.copy(vector(pose.position));
    return new Group().add(placed(this.shape.draw(), pose), visual);
  }

  protected override describe({
    pose: { pose, covariance },
  }: PoseWithCovarianceStamped): Readonly<Record<string, unknown>> {
    const [x, y, z, roll, pitch, yaw] = [0, 7, 14, 21, 28, 35].map((index) => covariance[index] ?? NaN);
    return {
      Position: pose.position,
      Orientation: pose.orientation,
      "Covariance Position": { x, y, z },
      "Covariance Orientation": { x: roll, y: pitch, z: yaw },
    };
  }
}

register({
  className: "rviz/PoseWithCovariance",
  aliases: [],
  types: TYPES,
  create: (context) => new PoseWithCovarianceDisplay(context),
});
