/** rviz/Illuminance: a point at the sensor whose color is the illuminance [lux]. */

import type { Illuminance } from "../protocol/generated/ros_messages";
import { cloudOf, type Cloud } from "./clouds/cloud";
import { CloudDisplay } from "./clouds/cloud_display";
import { register } from "./registry";

const TYPES = ["sensor_msgs/Illuminance"];
/** Colors go from dark to the light of an overcast day. */
const CHANNEL = { channel: "illuminance", min: 0, max: 1000, invert: false };

class IlluminanceDisplay extends CloudDisplay<Illuminance> {
  readonly className = "rviz/Illuminance";

  protected read(message: Illuminance): Cloud {
    return cloudOf(["x", "y", "z", "illuminance"], new Float32Array([0, 0, 0, message.illuminance]));
  }
}

register({
  className: "rviz/Illuminance",
  aliases: [],
  types: TYPES,
  create: (context) => new IlluminanceDisplay(context, TYPES, CHANNEL),
});
