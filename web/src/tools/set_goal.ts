/** rviz's SetGoal, "2D Nav Goal": publishes a goal for navigation, or adds goals to the queue while that is asked for. */

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

  protected override get repeats(): boolean {
    return this.context.goals.collects.peek();
  }

  protected override publish(position: Vector3, yaw: number): void {
    const { connection, names, goals, fixedFrame } = this.context;
    const pose = this.poseOf(position, yaw);
    if (this.repeats) goals.add({ frame: fixedFrame.peek(), pose });
    else connection.publish(names.resolve(this.topic.value.peek()), TYPE, { header: this.header(), pose });
  }
}
