/** rviz's Orbit: the camera circles a focal point. */

import { OrthographicCamera, Vector3, type PerspectiveCamera } from "three";

import type { Transform } from "../../frames/transform";
import { NumberProperty, VectorProperty } from "../../rviz/properties";
import type { SixSides } from "../view_controller";
import { ProjectionProperty } from "./projection";
import { ORIGIN, SIDES, triple, View, wrapAngle, type Motion, type Picture } from "./view";

/** Turn per pixel of a drag [rad], as in rviz. */
const TURN = 0.005;
const STEEPEST = Math.PI / 2 - 0.001;
const NEAREST = 0.01;
/** Share of the free part that a framed sphere fills. */
const FILL = 0.9;
/** Distance of a camera without perspective [m]. */
const FAR_AWAY = 500;
const UP = new Vector3(0, 0, 1);

export class Orbit extends View {
  readonly className: string = "rviz/Orbit";
  readonly projection = this.add(new ProjectionProperty());
  readonly distance = this.add(new NumberProperty("Distance", 10, { min: NEAREST, unit: "m" }));
  readonly fieldOfView = this.add(
    new NumberProperty("Field of View", Math.PI / 4, { min: 0.05, max: 2.8, unit: "rad" }),
  );
  readonly focalPoint = this.add(new VectorProperty("Focal Point", [0, 0, 0]));
  readonly yaw = this.add(new NumberProperty("Yaw", Math.PI / 4, { unit: "rad" }));
  readonly pitch = this.add(new NumberProperty("Pitch", Math.PI / 4, { min: -STEEPEST, max: STEEPEST, unit: "rad" }));

  get kind(): "perspective" | "orthographic" {
    return this.projection.isOrthographic ? "orthographic" : "perspective";
  }

  override place(camera: PerspectiveCamera | OrthographicCamera, target: Transform, picture: Picture): void {
    camera.up.copy(UP);
    if (camera instanceof OrthographicCamera) {
      this.placeFar(camera, target, picture);
      return;
    }
    camera.position.copy(this.eye(target));
    camera.lookAt(this.focus(target));
    this.setRange(camera, this.distance.value.peek());
    camera.fov = (this.fieldOfView.value.peek() * 180) / Math.PI;
  }

  /** Place the camera far away, so that nothing is behind it; the scale at the focal point is that with perspective. */
  private placeFar(camera: OrthographicCamera, target: Transform, { width, height }: Picture): void {
    const distance = this.distance.value.peek();
    const away = Math.max(FAR_AWAY, 4 * distance);
    const focus = this.focus(target);
    camera.position.copy(focus).addScaledVector(this.outward(target), away);
    camera.lookAt(focus);
    camera.top = distance * Math.tan(this.fieldOfView.value.peek() / 2);
    camera.right = (camera.top * width) / height;
    [camera.left, camera.bottom] = [-camera.right, -camera.top];
    [camera.near, camera.far] = [0.1, 2 * away];
  }

  /** Unit vector from the focal point to the camera. */
  protected outward(target: Transform): Vector3 {
    const [yaw, pitch] = [this.yaw.value.peek(), this.pitch.value.peek()];
    const direction = new Vector3(Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch));
    return direction.applyQuaternion(this.frameOf(target).orientation);
  }

  /** The frame in which focal point and yaw are: that of the target's origin, with the fixed frame's axes. */
  protected frameOf(target: Transform): Transform {
    return { position: target.position, orientation: ORIGIN.orientation };
  }

  override focus(target: Transform): Vector3 {
    const { position, orientation } = this.frameOf(target);
    return new Vector3(...this.focalPoint.value.peek()).applyQuaternion(orientation).add(position);
  }

  /** Coordinates of a point of the fixed frame in the view's. */
  protected local(point: Vector3, target: Transform): Vector3 {
    const { position, orientation } = this.frameOf(target);
    return point.clone().sub(position).applyQuaternion(orientation.clone().invert());
  }

  override rotate(dx: number, dy: number): void {
    this.yaw.value.value = wrapAngle(this.yaw.value.peek() - dx * TURN);
    this.pitch.value.value = clampPitch(this.pitch.value.peek() + dy * TURN);
  }

  override pan(dx: number, dy: number, picture: Picture): void {
    const perPixel = (2 * this.distance.value.peek() * Math.tan(this.fieldOfView.value.peek() / 2)) / picture.height;
    const [yaw, pitch] = [this.yaw.value.peek(), this.pitch.value.peek()];
    const right = new Vector3(-Math.sin(yaw), Math.cos(yaw), 0);
    const up = new Vector3(-Math.cos(yaw) * Math.sin(pitch), -Math.sin(yaw) * Math.sin(pitch), Math.cos(pitch));
    const focus = new Vector3(...this.focalPoint.value.peek());
    this.focalPoint.value.value = triple(
      focus.addScaledVector(right, -dx * perPixel).addScaledVector(up, dy * perPixel),
    );
  }

  override zoom(factor: number): void {
    this.distance.value.value = Math.max(NEAREST, this.distance.value.peek() * factor);
  }

  override raise(dy: number): void {
    const outward = this.outward(ORIGIN).multiplyScalar(0.01 * dy * this.distance.value.peek());
    this.focalPoint.value.value = triple(new Vector3(...this.focalPoint.value.peek()).add(outward));
  }

  override frame(centre: Vector3, radius: number, target: Transform, picture: Picture): Motion[] {
    const motions: Motion[] = [{ property: this.focalPoint, to: triple(this.local(centre, target)) }];
    if (radius > 0) {
      const half = Math.tan(this.fieldOfView.value.peek() / 2);
      const share = Math.min(picture.free.height, picture.free.width) / picture.height;
      const to = Math.max(NEAREST, radius / (FILL * Math.sin(Math.atan(half * share))));
      motions.push({ property: this.distance, to, kind: "scale" });
    }
    return motions;
  }

  override lookFrom(side: SixSides): Motion[] {
    const [yaw, pitch] = SIDES[side];
    return [
      { property: this.yaw, to: yaw, kind: "angle" },
      { property: this.pitch, to: clampPitch(pitch), kind: "angle" },
    ];
  }

  override mimic(eye: Vector3, focus: Vector3, target: Transform): void {
    const out = this.local(eye, target).sub(this.local(focus, target));
    const distance = Math.max(NEAREST, out.length());
    this.distance.value.value = distance;
    this.focalPoint.value.value = triple(this.local(focus, target));
    if (Math.hypot(out.x, out.y) > 1e-3 * distance) this.yaw.value.value = Math.atan2(out.y, out.x);
    this.pitch.value.value = clampPitch(Math.asin(out.z / distance));
  }

  override eye(target: Transform): Vector3 {
    return this.focus(target).addScaledVector(this.outward(target), this.distance.value.peek());
  }

  override centre(): Motion[] {
    return [{ property: this.focalPoint, to: [0, 0, 0] }];
  }
}

function clampPitch(pitch: number): number {
  return Math.min(STEEPEST, Math.max(-STEEPEST, pitch));
}
