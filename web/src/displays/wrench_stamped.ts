/** rviz/WrenchStamped. */

import type { WrenchStamped } from "../protocol/generated/ros_messages";
import { register } from "./registry";
import { ScrewDisplay, type Screw } from "./screw_display";

const TYPES = ["geometry_msgs/WrenchStamped"];

class WrenchStampedDisplay extends ScrewDisplay<WrenchStamped> {
  readonly className = "rviz/WrenchStamped";

  protected screw({ wrench }: WrenchStamped): Screw {
    return { linear: wrench.force, angular: wrench.torque };
  }
}

register({
  className: "rviz/WrenchStamped",
  aliases: ["rviz_default_plugins/Wrench"],
  types: TYPES,
  create: (context) => new WrenchStampedDisplay(context, TYPES, "Force", "Torque"),
});
