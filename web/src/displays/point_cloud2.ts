/** rviz/PointCloud2. */

import type { PointCloud2 } from "../protocol/generated/ros_messages";
import { readCloud, type Cloud } from "./clouds/cloud";
import { CloudDisplay } from "./clouds/cloud_display";
import { register } from "./registry";

const TYPES = ["sensor_msgs/PointCloud2"];

class PointCloud2Display extends CloudDisplay<PointCloud2> {
  readonly className = "rviz/PointCloud2";

  protected read(message: PointCloud2): Cloud | string {
    return readCloud(message);
  }
}

register({
  className: "rviz/PointCloud2",
  aliases: [],
  types: TYPES,
  create: (context) => new PointCloud2Display(context, TYPES),
});
