/** rviz/FluidPressure: a point at the sensor whose color is the pressure [Pa]. */

import type { FluidPressure } from "../protocol/generated/ros_messages";
import { cloudOf, type Cloud } from "./clouds/cloud";
import { CloudDisplay } from "./clouds/cloud_display";
import { register } from "./registry";

const TYPES = ["sensor_msgs/FluidPressure"];
/** Colors go from low to high pressure of the air. */
const CHANNEL = { channel: "fluid_pressure", min: 98000, max: 105000, invert: false };

class FluidPressureDisplay extends CloudDisplay<FluidPressure> {
  readonly className = "rviz/FluidPressure";

  protected read(message: FluidPressure): Cloud {
    return cloudOf(["x", "y", "z", "fluid_pressure"], new Float32Array([0, 0, 0, message.fluid_pressure]));
  }
}

register({
  className: "rviz/FluidPressure",
  aliases: [],
  types: TYPES,
  create: (context) => new FluidPressureDisplay(context, TYPES, CHANNEL),
});
