/** Base of the tools that set a pose on the ground: press for the place, drag for the yaw. */

import { computed } from "@preact/signals";
import { MathUtils, OrthographicCamera, Vector3, type PerspectiveCamera } from "three";

import { Arrow } from "../shapes/arrow";
import type { Rgb, TopicProperty } from "../rviz/properties";
import type { Pose } from "../protocol/generated/ros_messages";
import { NOT_PICKED } from "../scene/picking";
import { BaseTool } from "./base_tool";
import type { PointerInput } from "../scene/pointer_input";

/** rviz's arrow [m]. */
const PROPORTIONS = { shaftLength: 2, shaftDiameter: 0.2, headLength: 0.5, headDiameter: 0.35 };
/** Length of the arrow as a ratio of the height that the camera sees there; rviz's arrow has a fixed size. */
const LENGTH = 0.15;

export abstract class PoseTool extends BaseTool {
  override readonly acts = true;
  protected abstract readonly color: Rgb;
  abstract readonly topic: TopicProperty;
  override readonly navigates = computed(() => this.context.names.resolve(this.topic.value.value));
  /** True: the tool stays on for another pose. */
  protected get repeats(): boolean {
    return false;
  }
  private start: Vector3 | null = null;
  private yaw = 0;
  private readonly arrow = new Arrow(PROPORTIONS);

  activate(): void {
    this.hint.value = "Press at its position, drag in its direction.";
    this.arrow.setColor(this.color);
    this.arrow.userData[NOT_PICKED] = true;
  }

  deactivate(): void {
    this.start = null;
    this.arrow.removeFromParent();
    this.context.scene.invalidate();
  }

  pointer(input: PointerInput): boolean {
    if (input.kind === "down") return input.button === 0 && this.press(input);
    const { start } = this;
    if (start === null) return false;
    if (input.kind === "move") this.turn(start, input);
    else if (input.kind === "cancel") this.deactivate();
    else {
      this.deactivate();
      this.publish(start, this.yaw);
      if (!this.repeats) this.finish();
    }
    return true;
  }

  /** Send the pose: a place on the ground of the fixed frame, and the yaw [rad]. */
  protected abstract publish(position: Vector3, yaw: number): void;

  protected poseOf({ x, y }: Vector3, yaw: number): Pose {
    return { position: { x, y, z: 0 }, orientation: { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) } };
  }

  private press(input: PointerInput): boolean {
    const { scene } = this.context;
    this.start = scene.pickGround(input.x, input.y);
    if (this.start === null) return false;
    this.yaw = 0;
    const size = LENGTH * seenHeight(scene.camera.peek(), this.start);
    this.arrow.scale.setScalar(size / (PROPORTIONS.shaftLength + PROPORTIONS.headLength));
    this.arrow.position.copy(this.start);
    this.arrow.rotation.set(0, 0, 0);
    scene.displays.add(this.arrow);
    scene.invalidate();
    return true;
  }

  private turn(start: Vector3, { x, y }: PointerInput): void {
    const to = this.context.scene.pickGround(x, y);
    if (to === null || to.distanceTo(start) < 1e-6) return;
    this.yaw = Math.atan2(to.y - start.y, to.x - start.x);
    this.arrow.rotation.set(0, 0, this.yaw);
    const degrees = ((this.yaw * 180) / Math.PI).toFixed(0);
    this.hint.value = `x ${start.x.toFixed(2)} m, y ${start.y.toFixed(2)} m, yaw ${degrees}°`.replace(/-/g, "−");
    this.context.scene.invalidate();
  }
}

/** Height that a camera sees at a point [m]. */
function seenHeight(camera: PerspectiveCamera | OrthographicCamera, point: Vector3): number {
  if (camera instanceof OrthographicCamera) return (camera.top - camera.bottom) / camera.zoom;
  return 2 * Math.tan(MathUtils.degToRad(camera.getEffectiveFOV() / 2)) * camera.position.distanceTo(point);
}
