/** rviz/Temperature: a point at the sensor whose color is the temperature [°C]. */

import type { Temperature } from "../protocol/generated/ros_messages";
import { cloudOf, type Cloud } from "./clouds/cloud";
import { CloudDisplay } from "./clouds/cloud_display";
import { register } from "./registry";

const TYPES = ["sensor_msgs/Temperature"];
/** Colors go from freezing to boiling water. */
const CHANNEL = { channel: "temperature", min: 0, max: 100, invert: true };

class TemperatureDisplay extends CloudDisplay<Temperature> {
  readonly className = "rviz/Temperature";

  protected read(message: Temperature): Cloud {
    return cloudOf(["x", "y", "z", "temperature"], new Float32Array([0, 0, 0, message.temperature]));
  }
}

register({
  className: "rviz/Temperature",
  aliases: [],
  types: TYPES,
  create: (context) => new TemperatureDisplay(context, TYPES, CHANNEL),
});
