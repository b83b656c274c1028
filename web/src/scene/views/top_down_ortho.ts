/** rviz's TopDownOrtho: the ground from above, without perspective. */

import { OrthographicCamera, Vector3, type PerspectiveCamera } from "three";

import type { Transform } from "../../frames/transform";
import { NumberProperty } from "../../rviz/properties";
import type { SixSides } from "../view_controller";
import { View, wrapAngle, type Motion, type Picture } from "./view";

const TURN = 0.005;
/** Height of the camera over the target [m], as in rviz. */
const HEIGHT = 500;
/** Scale [px/m] of a picture of about 800 px by a lens of 45° at 1 m. */
const SCALE_AT_1_M = 1000;
const MIN_SCALE = 0.01;
const FILL = 0.9;

export class TopDownOrtho extends View {
  readonly className = "rviz/TopDownOrtho";
  readonly kind = "orthographic";
  readonly angle = this.add(new NumberProperty("Angle", 0, { unit: "rad" }));
  readonly scale = this.add(new NumberProperty("Scale", 10, { min: MIN_SCALE, unit: "px/m" }));
  readonly x = this.add(new NumberProperty("X", 0, { unit: "m" }));
  readonly y = this.add(new NumberProperty("Y", 0, { unit: "m" }));

  override place(camera: PerspectiveCamera | OrthographicCamera, target: Transform, picture: Picture): void {
    camera.position.copy(this.focus(target)).setZ(target.position.z + HEIGHT);
    camera.quaternion.setFromAxisAngle(new Vector3(0, 0, 1), this.angle.value.peek());
    this.setRange(camera, 1);
    if (!(camera instanceof OrthographicCamera)) return;
    camera.far = 2 * HEIGHT;
    camera.right = picture.width / 2 / this.scale.value.peek();
    camera.top = picture.height / 2 / this.scale.value.peek();
    camera.left = -camera.right;
    camera.bottom = -camera.top;
  }

  override focus(target: Transform): Vector3 {
    return new Vector3(
      this.x.value.peek() + target.position.x,
      this.y.value.peek() + target.position.y,
      target.position.z,
    );
  }

  override rotate(dx: number): void {
    this.angle.value.value = wrapAngle(this.angle.value.peek() + dx * TURN);
  }

  override pan(dx: number, dy: number): void {
    const angle = this.angle.value.peek();
    const [right, up] = [-dx / this.scale.value.peek(), dy / this.scale.value.peek()];
    this.x.value.value += right * Math.cos(angle) - up * Math.sin(angle);
    this.y.value.value += right * Math.sin(angle) + up * Math.cos(angle);
  }

  override zoom(factor: number): void {
    this.scale.value.value = Math.max(MIN_SCALE, this.scale.value.peek() / factor);
  }

  override frame(centre: Vector3, radius: number, target: Transform, picture: Picture): Motion[] {
    const motions: Motion[] = [
      { property: this.x, to: centre.x - target.position.x, kind: "length" },
      { property: this.y, to: centre.y - target.position.y, kind: "length" },
    ];
    const free = Math.min(picture.free.width, picture.free.height);
    if (radius > 0)
      motions.push({ property: this.scale, to: Math.max(MIN_SCALE, (FILL * free) / (2 * radius)), kind: "scale" });
    return motions;
  }

  override lookFrom(side: SixSides): Motion[] | null {
    return side === "top" ? [{ property: this.angle, to: 0, kind: "angle" }] : null;
  }

  /** Look at the ground under the other view's focal point, at about the same scale. */
  override mimic(eye: Vector3, focus: Vector3, target: Transform): void {
    this.x.value.value = focus.x - target.position.x;
    this.y.value.value = focus.y - target.position.y;
    this.scale.value.value = Math.max(MIN_SCALE, SCALE_AT_1_M / Math.max(0.1, eye.distanceTo(focus)));
  }

  override eye(target: Transform): Vector3 {
    return this.focus(target).add(new Vector3(0, 0, SCALE_AT_1_M / this.scale.value.peek()));
  }

  override centre(): Motion[] {
    return [
      { property: this.x, to: 0, kind: "length" },
      { property: this.y, to: 0, kind: "length" },
    ];
  }
}
