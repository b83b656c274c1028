/** rviz/PointCloud: the older message, points with channels beside them. */

import type { PointCloud } from "../protocol/generated/ros_messages";
import { cloudOf, type Cloud } from "./clouds/cloud";
import { CloudDisplay } from "./clouds/cloud_display";
import { register } from "./registry";

const TYPES = ["sensor_msgs/PointCloud"];
/** The GPU reads points with a stride of at most 252 bytes. */
const MAX_CHANNELS = 60;

class PointCloudDisplay extends CloudDisplay<PointCloud> {
  readonly className = "rviz/PointCloud";

  protected read({ points, channels: all }: PointCloud): Cloud {
    const channels = all.slice(0, MAX_CHANNELS);
    const width = 3 + channels.length;
    const values = new Float32Array(points.length * width);
    points.forEach(({ x, y, z }, index) => values.set([x, y, z], index * width));
    channels.forEach((channel, number) => {
      if (channel.values.length !== points.length) return; // rviz leaves a channel of another length at 0
      channel.values.forEach((value, index) => (values[index * width + 3 + number] = value));
    });
    return cloudOf(["x", "y", "z", ...channels.map(({ name }) => name)], values);
  }
}

register({
  className: "rviz/PointCloud",
  aliases: [],
  types: TYPES,
  create: (context) => new PointCloudDisplay(context, TYPES),
});
