/** rviz/LaserScan: each ray's end, at the pose that the sensor had when it was measured. */

import { Quaternion, Vector3 } from "three";

import type { Transform } from "../frames/transform";
import type { LaserScan } from "../protocol/generated/ros_messages";
import { nanoseconds } from "../protocol/ros_types";
import { cloudOf, type Cloud } from "./clouds/cloud";
import { CloudDisplay } from "./clouds/cloud_display";
import { register } from "./registry";
import { areFinite, INVALID_FLOATS } from "../frames/valid";

const TYPES = ["sensor_msgs/LaserScan"];
/** A scan that takes longer [s] gets a warning, since it is shown only after its last ray. */
const LONG_SCAN_S = 1;
const AT_ORIGIN: Transform = { position: new Vector3(), orientation: new Quaternion() };

class LaserScanDisplay extends CloudDisplay<LaserScan> {
  readonly className = "rviz/LaserScan";

  protected override fault(scan: LaserScan): string | null {
    const { angle_min, angle_increment, time_increment, range_min } = scan;
    if (!areFinite([angle_min, angle_increment, time_increment, range_min])) return INVALID_FLOATS;
    const duration = Math.abs(time_increment * scan.ranges.length);
    if (duration <= LONG_SCAN_S) this.clearStatus("Scan Time");
    else {
      const text =
        `Laser scan time, computed from time_increment * len(ranges), is rather large: ${Math.trunc(duration)}s.\n` +
        "The display of any message will be delayed by this amount of time!";
      this.setStatus("Scan Time", "warn", text);
    }
    return null;
  }

  protected override endTime({ header, ranges, time_increment }: LaserScan): bigint | null {
    const duration = time_increment * Math.max(0, ranges.length - 1);
    return duration === 0 ? null : nanoseconds(header.stamp) + BigInt(Math.round(duration * 1e9));
  }

  /** Identity, since the points are in the fixed frame already. */
  protected override pose(): Transform {
    return AT_ORIGIN;
  }

  protected read(scan: LaserScan, start: Transform, end: Transform): Cloud {
    return project(scan, start, end);
  }
}

/**
 * Points of a scan in the fixed frame, as laser_geometry projects them: for ranges from `range_min` to below
 * `range_max`, with the sensor's pose interpolated between the first and the last ray.
 */
export function project(scan: LaserScan, start: Transform, end: Transform): Cloud {
  const { ranges, intensities, angle_min, angle_increment, range_min, range_max } = scan;
  const hasIntensity = intensities.length > 0;
  const width = hasIntensity ? 4 : 3;
  const values = new Float32Array(ranges.length * width);
  const point = new Vector3();
  const origin = new Vector3();
  const orientation = new Quaternion();
  let count = 0;
  ranges.forEach((range, index) => {
    if (!(range >= range_min && range < range_max)) return;
    const share = ranges.length > 1 ? index / (ranges.length - 1) : 0;
    const angle = angle_min + index * angle_increment;
    orientation.slerpQuaternions(start.orientation, end.orientation, share);
    origin.lerpVectors(start.position, end.position, share);
    point
      .set(range * Math.cos(angle), range * Math.sin(angle), 0)
      .applyQuaternion(orientation)
      .add(origin);
    point.toArray(values, count * width);
    if (hasIntensity) values[count * width + 3] = intensities[index] ?? 0;
    count += 1;
  });
  return cloudOf(hasIntensity ? ["x", "y", "z", "intensity"] : ["x", "y", "z"], values.subarray(0, count * width));
}

register({
  className: "rviz/LaserScan",
  aliases: [],
  types: TYPES,
  create: (context) => new LaserScanDisplay(context, TYPES),
});
