/** rviz/RelativeHumidity: a point at the sensor whose color is the relative humidity, 0…1. */

import type { RelativeHumidity } from "../protocol/generated/ros_messages";
import { cloudOf, type Cloud } from "./clouds/cloud";
import { CloudDisplay } from "./clouds/cloud_display";
import { register } from "./registry";

const TYPES = ["sensor_msgs/RelativeHumidity"];
/** Colors go from dry to saturated air. */
const CHANNEL = { channel: "relative_humidity", min: 0, max: 1, invert: false };

class RelativeHumidityDisplay extends CloudDisplay<RelativeHumidity> {
  readonly className = "rviz/RelativeHumidity";

  protected read(message: RelativeHumidity): Cloud {
    return cloudOf(["x", "y", "z", "relative_humidity"], new Float32Array([0, 0, 0, message.relative_humidity]));
  }
}

register({
  className: "rviz/RelativeHumidity",
  aliases: [],
  types: TYPES,
  create: (context) => new RelativeHumidityDisplay(context, TYPES, CHANNEL),
});
