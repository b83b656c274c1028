/** rviz's PublishPoint: publishes the clicked point. */

import { BoolProperty, TopicProperty } from "../rviz/properties";
import { BaseTool } from "./base_tool";
import type { PointerInput } from "../scene/pointer_input";

const TYPE = "geometry_msgs/PointStamped";

export class PublishPoint extends BaseTool {
  override readonly acts = true;
  readonly className = "rviz/PublishPoint";
  readonly name = "Publish Point";
  readonly shortcut = "u";
  readonly icon = "point";
  readonly singleClick = this.add(
    new BoolProperty("Single click", true, { description: "Return to the previous tool after one click" }),
  );
  readonly topic = this.add(new TopicProperty("Topic", "/clicked_point", [TYPE]));

  activate(): void {
    this.hint.value = "Click the point to publish.";
  }

  deactivate(): void {
    // the tool has no state
  }

  pointer({ kind, button, x, y }: PointerInput): boolean {
    if (kind === "down" && button !== 0) return false;
    const { scene, connection, names } = this.context;
    if (kind !== "down" && kind !== "move") return true;
    const point = scene.pick(x, y)?.point ?? scene.pickGround(x, y);
    if (point === null) return false;
    this.hint.value = `x ${point.x.toFixed(3)} m, y ${point.y.toFixed(3)} m, z ${point.z.toFixed(3)} m`.replace(
      /-/g,
      "−",
    );
    if (kind === "move") return false;
    const message = { header: this.header(), point: { x: point.x, y: point.y, z: point.z } };
    connection.publish(names.resolve(this.topic.value.peek()), TYPE, message);
    if (this.singleClick.value.peek()) this.finish();
    return true;
  }
}
