/** rviz's SetInitialPose, "2D Pose Estimate": publishes the robot's pose for localization. */

import type { Vector3 } from "three";

import { NumberProperty, TopicProperty, type Rgb } from "../rviz/properties";
import { PoseTool } from "./pose_tool";

const TYPE = "geometry_msgs/PoseWithCovarianceStamped";

export class SetInitialPose extends PoseTool {
  readonly className = "rviz/SetInitialPose";
  readonly name = "2D Pose Estimate";
  readonly shortcut = "p";
  readonly icon = "pose";
  protected override readonly color: Rgb = [0, 255, 0];
  readonly topic = this.add(new TopicProperty("Topic", "/initialpose", [TYPE]));
  readonly xDeviation = this.add(new NumberProperty("X std deviation", 0.5, { min: 0, unit: "m" }));
  readonly yDeviation = this.add(new NumberProperty("Y std deviation", 0.5, { min: 0, unit: "m" }));
  readonly thetaDeviation = this.add(new NumberProperty("Theta std deviation", Math.PI / 12, { min: 0, unit: "rad" }));

  protected override publish(position: Vector3, yaw: number): void {
    const covariance = new Float64Array(36);
    [this.xDeviation, this.yDeviation, this.thetaDeviation].forEach((deviation, i) => {
      covariance[[0, 7, 35][i] ?? 0] = deviation.value.peek() ** 2;
    });
    const message = { header: this.header(), pose: { pose: this.poseOf(position, yaw), covariance } };
    const { connection, names } = this.context;
    connection.publish(names.resolve(this.topic.value.peek()), TYPE, message);
  }
}
