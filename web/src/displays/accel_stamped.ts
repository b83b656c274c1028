/** rviz/AccelStamped. */

import type { AccelStamped } from "../protocol/generated/ros_messages";
import { register } from "./registry";
import { ScrewDisplay, type Screw } from "./screw_display";

const TYPES = ["geometry_msgs/AccelStamped"];

class AccelStampedDisplay extends ScrewDisplay<AccelStamped> {
  readonly className = "rviz/AccelStamped";

  protected screw({ accel }: AccelStamped): Screw {
    return accel;
  }
}

register({
  className: "rviz/AccelStamped",
  aliases: [],
  types: TYPES,
  create: (context) => new AccelStampedDisplay(context, TYPES, "Linear", "Angular"),
});
