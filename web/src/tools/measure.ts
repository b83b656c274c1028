/** rviz's Measure: measures the distance between two clicked points. */

import { BufferAttribute, BufferGeometry, Line, LineBasicMaterial, Object3D, Vector3 } from "three";

import { NOT_PICKED } from "../scene/picking";
import type { Label } from "../scene/scene_view";
import { BaseTool } from "./base_tool";
import type { PointerInput } from "../scene/pointer_input";

export class Measure extends BaseTool {
  readonly className = "rviz/Measure";
  readonly name = "Measure";
  readonly shortcut = "n";
  readonly icon = "measure";
  private state: "empty" | "open" | "closed" = "empty";
  private readonly ends = new BufferAttribute(new Float32Array(6), 3);
  private readonly line = new Line(
    new BufferGeometry().setAttribute("position", this.ends),
    new LineBasicMaterial({ depthTest: false }),
  );
  private readonly middle = new Object3D();
  private label: Label | null = null;
  private readonly start = new Vector3();

  activate(): void {
    this.line.frustumCulled = false;
    this.line.renderOrder = 1000;
    this.line.userData[NOT_PICKED] = true;
    this.clear();
  }

  deactivate(): void {
    this.clear();
  }

  pointer({ kind, button, x, y }: PointerInput): boolean {
    if (kind === "down" && button === 2) {
      this.clear();
      return true;
    }
    if (kind === "down" && button !== 0) return false;
    const isPress = kind === "down";
    if (!isPress && (kind !== "move" || this.state !== "open")) return true;
    const point = this.context.scene.pick(x, y)?.point ?? this.context.scene.pickGround(x, y);
    if (point === null) return true;
    if (this.state === "open") {
      this.show(point);
      if (isPress) this.state = "closed";
    } else if (isPress) this.begin(point);
    return true;
  }

  private begin(point: Vector3): void {
    this.clear();
    this.state = "open";
    this.start.copy(point);
    const { scene } = this.context;
    scene.displays.add(this.line, this.middle);
    this.label = scene.addLabel(this.middle, "");
    this.show(point);
  }

  private show(point: Vector3): void {
    const { scene } = this.context;
    this.ends.setXYZ(0, this.start.x, this.start.y, this.start.z);
    this.ends.setXYZ(1, point.x, point.y, point.z);
    this.ends.needsUpdate = true;
    this.middle.position.copy(this.start).add(point).multiplyScalar(0.5);
    this.line.material.color.set(getComputedStyle(scene.element).getPropertyValue("--accent").trim() || "#3fbed0");
    const text = `${this.start.distanceTo(point).toFixed(3)} m`;
    if (this.label !== null) this.label.text = text;
    this.hint.value = `${text}. Right click starts again.`;
    scene.invalidate();
  }

  private clear(): void {
    this.state = "empty";
    this.label?.remove();
    this.label = null;
    this.line.removeFromParent();
    this.middle.removeFromParent();
    this.hint.value = "Click two points.";
    this.context.scene.invalidate();
  }
}
