/** Puts a model, a shape or a light where the person clicks, as Gazebo's Insert tab does. */

import { signal } from "@preact/signals";
import { Color, PerspectiveCamera, Vector3 } from "three";

import { BaseTool } from "./base_tool";
import type { Insertable } from "../page/insertable";
import type { Inserter } from "../page/tool";
import { InsertionGhost } from "./insertion_ghost";
import type { PointerInput } from "../scene/pointer_input";

/** A point of the ground farther than this is taken for a part of the sky [m]. */
const FARTHEST = 500;
/** Heights of the free part of the view, from its middle down, at one of which the ground is met. */
const DOWN = [0.5, 0.6, 0.7, 0.8, 0.9];

export class InsertTool extends BaseTool implements Inserter {
  readonly className = "trundle/Insert";
  readonly name = "Insert";
  readonly shortcut = "e";
  readonly icon = "plus";
  /** What is being inserted; null: nothing is chosen. */
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

  /** Have something follow the pointer; null: nothing any more. */
  choose(item: Insertable | null): void {
    const { scene } = this.context;
    this.ghost?.dispose();
    this.ghost = null;
    this.chosen.value = item;
    this.hint.value =
      item === null
        ? "Choose what to insert."
        : `Click where the ${item.title} is to be. Enter: in the middle. Esc: nowhere.`;
    if (item !== null) {
      const accent = getComputedStyle(scene.element).getPropertyValue("--accent").trim() || "#3fbed0";
      this.ghost = new InsertionGhost(item, new Color(accent), () => scene.invalidate());
      this.ghost.visible = false;
      scene.world.add(this.ghost);
    }
    scene.invalidate();
  }

  /** A click places; drags are the camera's. */
  pointer({ kind, button, x, y }: PointerInput): boolean {
    if (kind === "move") this.hover(x, y);
    else if (kind === "up" && button === 0) this.place(x, y);
    return false;
  }

  /** Show it where a point of the view [px] meets the world. */
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

  /** Insert what is chosen where a point of the view [px] meets the world; the tool's work is done. */
  place(x: number, y: number): void {
    const item = this.chosen.peek();
    const point = this.meet(x, y);
    if (item === null || point === null) return;
    this.onPlace(item, point);
    this.choose(null);
    this.finish();
  }

  /** Insert what is chosen in the middle of what is seen, or below it where the sky is there. */
  placeInMiddle(): void {
    const { left, top, width, height } = this.context.scene.freePart.peek();
    const x = left + width / 2;
    const y = DOWN.map((share) => top + share * height).find((candidate) => this.meet(x, candidate) !== null);
    if (y !== undefined) this.place(x, y);
    else this.hint.value = "Nothing but sky is seen: turn the view down.";
  }

  /** Where a point of the view [px] meets something, or the ground, in the world. */
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
