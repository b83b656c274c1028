/** Puts a model, a shape or a light where the person clicks, as Gazebo's Insert tab does. */

import { signal } from "@preact/signals";
import { Color, PerspectiveCamera, Vector3 } from "three";

import { BaseTool } from "./base_tool";
import type { Insertable } from "../page/insertable";
import type { Inserter } from "../page/tool";
import { InsertionGhost } from "./insertion_ghost";
import type { PointerInput } from "../scene/pointer_input";

/** Distance beyond which the ground counts as sky [m]. */
const FARTHEST = 500;
/** Heights in the view's free part, from its middle down, at which a ray to the ground is tried. */
const DOWN = [0.5, 0.6, 0.7, 0.8, 0.9];

export class InsertTool extends BaseTool implements Inserter {
  readonly className = "trundle/Insert";
  readonly name = "Insert";
  readonly shortcut = "e";
  readonly icon = "plus";
  /** Item being inserted; null: none. */
  readonly chosen = signal<Insertable | null>(null);
  /** Inserts something at a point of the world [m]. */
  onPlace: (item: Insertable, point: Vector3) => void = () => undefined;
  private ghost: InsertionGhost | null = null;

  activate(): void {
    this.choose(this.chosen.peek());
  }

  deactivate(): void {
    this.choose(null);
  }

  /** Choose the item that follows the pointer; null: none. */
  choose(item: Insertable | null): void {
    const { scene } = this.context;
    this.ghost?.dispose();
    this.ghost = null;
    this.chosen.value = item;
    this.hint.value =
      item === null
        ? "Choose what to insert."
        : `Click to place the ${item.title}. Enter: in the center of the view. Esc: cancel.`;
    if (item !== null) {
      const accent = getComputedStyle(scene.element).getPropertyValue("--accent").trim() || "#3fbed0";
      this.ghost = new InsertionGhost(item, new Color(accent), () => scene.invalidate());
      this.ghost.visible = false;
      scene.world.add(this.ghost);
    }
    scene.invalidate();
  }

  /** Insert by a click; drags move the camera. */
  pointer({ kind, button, x, y }: PointerInput): boolean {
    if (kind === "move") this.hover(x, y);
    else if (kind === "up" && button === 0) this.place(x, y);
    return false;
  }

  /** Show the item at the point of the world under a point of the view [px]. */
  hover(x: number, y: number): void {
    const point = this.meet(x, y);
    if (point === null) this.hide();
    else if (this.ghost !== null) {
      this.ghost.position.copy(point);
      this.ghost.visible = true;
      this.context.scene.invalidate();
    }
  }

  hide(): void {
    if (this.ghost?.visible !== true) return;
    this.ghost.visible = false;
    this.context.scene.invalidate();
  }

  /** Insert the item at the point of the world under a point of the view [px], and finish the tool. */
  place(x: number, y: number): void {
    const item = this.chosen.peek();
    const point = this.meet(x, y);
    if (item === null || point === null) return;
    this.onPlace(item, point);
    this.choose(null);
    this.finish();
  }

  /** Insert the item in the middle of the view, or below it if the sky is there. */
  placeInMiddle(): void {
    const { left, top, width, height } = this.context.scene.freePart.peek();
    const x = left + width / 2;
    const y = DOWN.map((share) => top + share * height).find((candidate) => this.meet(x, candidate) !== null);
    if (y !== undefined) this.place(x, y);
    else this.hint.value = "Only the sky is visible: turn the view down.";
  }

  /** Point of the world under a point of the view [px]: of an object, or of the ground. */
  private meet(x: number, y: number): Vector3 | null {
    const { scene } = this.context;
    const point = scene.pick(x, y)?.point ?? scene.pickGround(x, y);
    if (point === null || this.isNearHorizon(point)) return null;
    scene.world.updateWorldMatrix(true, false);
    return scene.world.worldToLocal(point.clone());
  }

  private isNearHorizon(point: Vector3): boolean {
    const camera = this.context.scene.camera.peek();
    return camera instanceof PerspectiveCamera && point.distanceTo(camera.getWorldPosition(new Vector3())) > FARTHEST;
  }
}
