/** rviz's XYOrbit: an Orbit whose focal point stays on the ground. */

import { Vector3 } from "three";

import type { Transform } from "../../frames/transform";
import { Orbit } from "./orbit";
import { triple, type Motion, type Picture } from "./view";

export class XYOrbit extends Orbit {
  override readonly className: string = "rviz/XYOrbit";

  /** Shift so that the ground follows the pointer; a nearly level view shifts as if it were steeper. */
  override pan(dx: number, dy: number, picture: Picture): void {
    const perPixel = (2 * this.distance.value.peek() * Math.tan(this.fieldOfView.value.peek() / 2)) / picture.height;
    const [yaw, pitch] = [this.yaw.value.peek(), this.pitch.value.peek()];
    const along = perPixel / Math.max(0.2, Math.abs(Math.sin(pitch)));
    const focus = new Vector3(...this.focalPoint.value.peek());
    focus.add(new Vector3(-Math.sin(yaw), Math.cos(yaw), 0).multiplyScalar(-dx * perPixel));
    focus.add(new Vector3(-Math.cos(yaw), -Math.sin(yaw), 0).multiplyScalar(dy * along * Math.sign(pitch || 1)));
    this.focalPoint.value.value = triple(focus.setZ(0));
  }

  override raise(): void {
    // the focal point stays on the ground
  }

  override frame(centre: Vector3, radius: number, target: Transform, picture: Picture): Motion[] {
    return super.frame(centre.clone().setZ(this.frameOf(target).position.z), radius, target, picture);
  }

  override mimic(eye: Vector3, focus: Vector3, target: Transform): void {
    const ground = this.frameOf(target).position.z;
    const ray = focus.clone().sub(eye);
    const share = (ground - eye.z) / ray.z;
    const isAhead = Number.isFinite(share) && share > 0 && share < 10;
    super.mimic(eye, isAhead ? eye.clone().addScaledVector(ray, share) : focus.clone().setZ(ground), target);
  }
}
