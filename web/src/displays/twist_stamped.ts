/** rviz/TwistStamped. */

import type { TwistStamped } from "../protocol/generated/ros_messages";
import { register } from "./registry";
import { ScrewDisplay, type Screw } from "./screw_display";

const TYPES = ["geometry_msgs/TwistStamped"];

class TwistStampedDisplay extends ScrewDisplay<TwistStamped> {
  readonly className = "rviz/TwistStamped";

  protected screw({ twist }: TwistStamped): Screw {
    return twist;
  }
}

register({
  className: "rviz/TwistStamped",
  aliases: [],
  types: TYPES,
  create: (context) => new TwistStampedDisplay(context, TYPES, "Linear", "Angular"),
});
