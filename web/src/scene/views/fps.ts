/** rviz's FPS: the camera is moved as a first person's eye. */

import { Euler, PerspectiveCamera, Quaternion, Vector3, type OrthographicCamera } from "three";

import type { Transform } from "../../frames/transform";
import { NumberProperty, VectorProperty } from "../../rviz/properties";
import type { SixSides } from "../view_controller";
import { SIDES, triple, View, wrapAngle, type Motion, type Picture } from "./view";

const TURN = 0.005;
const STEEPEST = Math.PI / 2 - 0.001;
/** Metres per pixel of a drag, and of a step. */
const MOVE = 0.01;
/** Default distance of the focal point [m]. */
const AHEAD = 5;
/** Turns a camera that looks along −z with y up into one that looks along x with z up. */
const LENS = new Quaternion().setFromEuler(new Euler(Math.PI / 2, 0, -Math.PI / 2, "ZYX"));

export class Fps extends View {
  readonly className: string = "rviz/FPS";
  readonly kind = "perspective";
  readonly fieldOfView = this.add(
    new NumberProperty("Field of View", Math.PI / 4, { min: 0.05, max: 2.8, unit: "rad" }),
  );
  readonly pitch = this.add(new NumberProperty("Pitch", 0.5, { min: -STEEPEST, max: STEEPEST, unit: "rad" }));
  readonly position = this.add(new VectorProperty("Position", [-5, -5, 5]));
  readonly roll = this.add(new NumberProperty("Roll", 0, { unit: "rad" }));
  readonly yaw = this.add(new NumberProperty("Yaw", Math.PI / 4, { unit: "rad" }));

  override place(camera: PerspectiveCamera | OrthographicCamera, target: Transform, _picture: Picture): void {
    const { orientation } = this.frameOf(target);
    camera.position.copy(this.eye(target));
    camera.quaternion.copy(orientation).multiply(this.turn()).multiply(LENS);
    this.setRange(camera, 1);
    if (camera instanceof PerspectiveCamera) camera.fov = (this.fieldOfView.value.peek() * 180) / Math.PI;
  }

  /** The frame in which position and angles are. */
  protected frameOf(target: Transform): Transform {
    return { position: target.position, orientation: new Quaternion() };
  }

  override eye(target: Transform): Vector3 {
    const { position, orientation } = this.frameOf(target);
    return this.localEye().applyQuaternion(orientation).add(position);
  }

  /** Position in the view's frame. */
  private localEye(): Vector3 {
    return new Vector3(...this.position.value.peek());
  }

  private turn(): Quaternion {
    return new Quaternion().setFromEuler(
      new Euler(this.roll.value.peek(), this.pitch.value.peek(), this.yaw.value.peek(), "ZYX"),
    );
  }

  private ahead(): Vector3 {
    return new Vector3(1, 0, 0).applyQuaternion(this.turn());
  }

  override focus(target: Transform): Vector3 {
    const { position, orientation } = this.frameOf(target);
    return this.localEye().addScaledVector(this.ahead(), AHEAD).applyQuaternion(orientation).add(position);
  }

  override rotate(dx: number, dy: number): void {
    this.yaw.value.value = wrapAngle(this.yaw.value.peek() - dx * TURN);
    this.pitch.value.value = Math.min(STEEPEST, Math.max(-STEEPEST, this.pitch.value.peek() + dy * TURN));
  }

  override pan(dx: number, dy: number): void {
    const step = new Vector3(0, dx * MOVE, dy * MOVE).applyQuaternion(this.turn());
    this.position.value.value = triple(this.localEye().add(step));
  }

  override zoom(factor: number): void {
    this.position.value.value = triple(this.localEye().addScaledVector(this.ahead(), AHEAD * (1 - factor)));
  }

  override frame(centre: Vector3, radius: number, target: Transform, picture: Picture): Motion[] {
    const { position, orientation } = this.frameOf(target);
    const local = centre.clone().sub(position).applyQuaternion(orientation.clone().invert());
    if (radius === 0) return this.lookAt(local);
    const share = Math.min(picture.free.width, picture.free.height) / picture.height;
    const away = radius / Math.sin(Math.atan(Math.tan(this.fieldOfView.value.peek() / 2) * share));
    return [{ property: this.position, to: triple(local.addScaledVector(this.ahead(), -away)) }];
  }

  private lookAt(point: Vector3): Motion[] {
    const direction = point.sub(this.localEye());
    return [
      { property: this.yaw, to: Math.atan2(direction.y, direction.x), kind: "angle" },
      { property: this.pitch, to: -Math.atan2(direction.z, Math.hypot(direction.x, direction.y)), kind: "angle" },
    ];
  }

  override lookFrom(side: SixSides): Motion[] {
    const [yaw, pitch] = SIDES[side];
    const out = new Vector3(Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch));
    const focus = this.localEye().addScaledVector(this.ahead(), AHEAD);
    return [
      { property: this.yaw, to: wrapAngle(yaw + Math.PI), kind: "angle" },
      { property: this.pitch, to: Math.min(STEEPEST, Math.max(-STEEPEST, pitch)), kind: "angle" },
      { property: this.position, to: triple(focus.addScaledVector(out, AHEAD)) },
    ];
  }

  override mimic(eye: Vector3, focus: Vector3, target: Transform): void {
    const { position, orientation } = this.frameOf(target);
    const back = orientation.clone().invert();
    const local = eye.clone().sub(position).applyQuaternion(back);
    const direction = focus.clone().sub(eye).applyQuaternion(back);
    this.position.value.value = triple(local);
    this.roll.value.value = 0;
    this.yaw.value.value = Math.atan2(direction.y, direction.x);
    this.pitch.value.value = Math.min(
      STEEPEST,
      Math.max(-STEEPEST, -Math.atan2(direction.z, Math.hypot(direction.x, direction.y))),
    );
  }

  override centre(): Motion[] {
    return [{ property: this.position, to: triple(this.ahead().multiplyScalar(-AHEAD)) }];
  }
}
