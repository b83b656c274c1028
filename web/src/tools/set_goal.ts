/** rviz's SetGoal, "2D Nav Goal": publishes a goal for navigation. */

import type { Vector3 } from "three";

import { TopicProperty, type Rgb } from "../rviz/properties";
import { PoseTool } from "./pose_tool";

const TYPE = "geometry_msgs/PoseStamped";

export class SetGoal extends PoseTool {
  readonly className = "rviz/SetGoal";
  readonly name = "2D Nav Goal";
  readonly shortcut = "g";
  readonly icon = "goal";
  protected override readonly color: Rgb = [255, 0, 255];
  readonly topic = this.add(new TopicProperty("Topic", "/move_base_simple/goal", [TYPE]));

  protected override publish(position: Vector3, yaw: number): void {
    const message = { header: this.header(), pose: this.poseOf(position, yaw) };
    const { connection, names } = this.context;
    connection.publish(names.resolve(this.topic.value.peek()), TYPE, message);
  }
}
