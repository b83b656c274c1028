/** rviz_imu_plugin/Imu: the orientation of an IMU as a box or axes, and its acceleration as an arrow. */

import { Group, Quaternion, Vector3, type Object3D } from "three";

import type { Transform } from "../frames/transform";
import type { Imu } from "../protocol/generated/ros_messages";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { BoolProperty, ColorProperty, GroupProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";
import { Arrow } from "../shapes/arrow";
import { Axes } from "../shapes/axes";
import { Solid } from "../shapes/solid";
import { BOX } from "../shapes/solids";
import { INVALID_FLOATS, isFiniteXyz, quaternion, vector } from "../frames/valid";

const TYPES = ["sensor_msgs/Imu"];
const X = new Vector3(1, 0, 0);
/** Widths of the arrow at a scale of 1 [m per m/s²]. */
const ARROW = { shaftDiameter: 0.5, headLength: 1, headDiameter: 1 };

class ImuDisplay extends HistoryDisplay<Imu> {
  readonly className = "rviz_imu_plugin/Imu";
  private readonly inFixedFrame = this.add(
    new BoolProperty("fixed_frame_orientation", true, {
      description: "Turn by the IMU's orientation from the fixed frame, not from its own.",
    }),
  );
  private readonly box = this.add(new GroupProperty("Box properties"));
  private readonly boxEnabled = this.box.add(new BoolProperty("Enable box", false));
  private readonly boxX = this.box.add(new NumberProperty("x_scale", 1, { unit: "m" }));
  private readonly boxY = this.box.add(new NumberProperty("y_scale", 1, { unit: "m" }));
  private readonly boxZ = this.box.add(new NumberProperty("z_scale", 1, { unit: "m" }));
  private readonly boxColor = this.box.add(new ColorProperty("Box color", [255, 0, 0]));
  private readonly boxAlpha = this.box.add(new NumberProperty("Box alpha", 1, { min: 0, max: 1 }));
  private readonly axes = this.add(new GroupProperty("Axes properties"));
  private readonly axesEnabled = this.axes.add(new BoolProperty("Enable axes", true));
  private readonly axesScale = this.axes.add(new NumberProperty("Axes scale", 1, { unit: "m" }));
  private readonly acceleration = this.add(new GroupProperty("Acceleration properties"));
  private readonly accelerationEnabled = this.acceleration.add(new BoolProperty("Enable acceleration", false));
  private readonly derotate = this.acceleration.add(
    new BoolProperty("Derotate acceleration", true, { description: "Turn the acceleration by the IMU's orientation." }),
  );
  private readonly accelerationScale = this.acceleration.add(new NumberProperty("Acc. vector scale", 1));
  private readonly accelerationColor = this.acceleration.add(new ColorProperty("Acc. vector color", [255, 0, 0]));
  private readonly accelerationAlpha = this.acceleration.add(
    new NumberProperty("Acc. vector alpha", 1, { min: 0, max: 1 }),
  );

  constructor(context: DisplayContext) {
    super(context, TYPES);
  }

  protected override fault({ orientation, linear_acceleration }: Imu): string | null {
    const isValid = isFiniteXyz(orientation) && Number.isFinite(orientation.w) && isFiniteXyz(linear_acceleration);
    return isValid ? null : INVALID_FLOATS;
  }

  protected override pose({ position, orientation }: Transform): Transform {
    return { position, orientation: this.inFixedFrame.value.peek() ? new Quaternion() : orientation };
  }

  protected draw(message: Imu): Object3D {
    const orientation = quaternion(message.orientation);
    const turned = new Group();
    turned.quaternion.copy(orientation);
    const group = new Group().add(turned);
    if (this.boxEnabled.value.peek()) {
      const box = new Solid(BOX, this.boxColor.value.peek(), this.boxAlpha.value.peek());
      box.scale.set(this.boxX.value.peek(), this.boxY.value.peek(), this.boxZ.value.peek());
      turned.add(box);
    }
    if (this.axesEnabled.value.peek()) {
      const axes = new Axes();
      axes.scale.setScalar(this.axesScale.value.peek());
      turned.add(axes);
    }
    if (this.accelerationEnabled.value.peek())
      group.add(this.drawAcceleration(vector(message.linear_acceleration), orientation));
    return group;
  }

  protected override describe({
    orientation,
    angular_velocity,
    linear_acceleration,
  }: Imu): Readonly<Record<string, unknown>> {
    return {
      Orientation: orientation,
      "Angular Velocity": angular_velocity,
      "Linear Acceleration": linear_acceleration,
    };
  }

  private drawAcceleration(acceleration: Vector3, orientation: Quaternion): Object3D {
    const scale = this.accelerationScale.value.peek();
    const { shaftDiameter, headLength, headDiameter } = ARROW;
    const arrow = new Arrow({
      shaftLength: acceleration.length() * scale,
      shaftDiameter: shaftDiameter * scale,
      headLength: headLength * scale,
      headDiameter: headDiameter * scale,
    });
    arrow.setColor(this.accelerationColor.value.peek(), this.accelerationAlpha.value.peek());
    if (this.derotate.value.peek()) acceleration.applyQuaternion(orientation);
    arrow.quaternion.setFromUnitVectors(X, acceleration.normalize());
    return arrow;
  }
}

register({
  className: "rviz_imu_plugin/Imu",
  aliases: [],
  types: TYPES,
  create: (context) => new ImuDisplay(context),
});
