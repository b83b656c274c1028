/** Units of fields whose names ROS fixes (REP 103: SI and radians). */

const BY_TYPE: Readonly<Record<string, Readonly<Record<string, string>>>> = {
  "sensor_msgs/LaserScan": {
    angle_min: "rad",
    angle_max: "rad",
    angle_increment: "rad",
    time_increment: "s",
    scan_time: "s",
    range_min: "m",
    range_max: "m",
    ranges: "m",
  },
  "sensor_msgs/Range": { field_of_view: "rad", min_range: "m", max_range: "m", range: "m" },
  "sensor_msgs/BatteryState": {
    voltage: "V",
    current: "A",
    charge: "Ah",
    capacity: "Ah",
    design_capacity: "Ah",
    temperature: "°C",
  },
  "sensor_msgs/Temperature": { temperature: "°C" },
  "sensor_msgs/FluidPressure": { fluid_pressure: "Pa" },
  "sensor_msgs/Illuminance": { illuminance: "lx" },
  "sensor_msgs/MagneticField": { magnetic_field: "T" },
  "sensor_msgs/NavSatFix": { latitude: "°", longitude: "°", altitude: "m" },
  "nav_msgs/OccupancyGrid": { resolution: "m" },
};

const BY_PARENT: Readonly<Record<string, string>> = {
  linear_acceleration: "m/s²",
  angular_velocity: "rad/s",
  position: "m",
  translation: "m",
  force: "N",
  torque: "N·m",
  magnetic_field: "T",
};

/**
 * Unit of the number at a path of field names in a message of a type; empty: unknown.
 * `twist.linear.x` is a speed, `accel.linear.x` an acceleration.
 */
export function unitOf(type: string, fields: readonly string[]): string {
  const [first = ""] = fields;
  const unit = BY_TYPE[type]?.[first];
  if (unit !== undefined) return unit;
  const above = fields.at(-2) ?? "";
  const isAcceleration = fields.includes("accel") || /Accel/.test(type);
  const isTwist = fields.includes("twist") || /Twist/.test(type) || isAcceleration;
  if (isTwist && above === "linear") return isAcceleration ? "m/s²" : "m/s";
  if (isTwist && above === "angular") return isAcceleration ? "rad/s²" : "rad/s";
  return BY_PARENT[above] ?? "";
}
