/** rviz's Interact: sends presses to objects with handlers, as interactive markers; other drags move the camera. */

import { BoolProperty } from "../rviz/properties";
import type { Pick, PointerTarget, TargetEvent } from "../scene/scene_view";
import { BaseTool } from "./base_tool";
import { PulledPoint } from "./handles/pulled_point";
import { pointerTargetOf, selectionOf } from "./picked";
import type { PointerInput } from "../scene/pointer_input";

export class Interact extends BaseTool {
  readonly className = "rviz/Interact";
  readonly name = "Interact";
  readonly shortcut = "i";
  readonly icon = "interact";
  override readonly cursor = "default";
  readonly hideInactive = this.add(new BoolProperty("Hide Inactive Objects", true));
  private hoveredTarget: PointerTarget | null = null;
  private dragged: PointerTarget | null = null;
  private waiting: PointerInput | null = null;
  /** Pressed object, which a click selects. */
  private pressed: Pick | null = null;
  private stop: (() => void) | null = null;
  /** Point that a drag with Ctrl pulls, as in MuJoCo's viewer. */
  private readonly pulled =
    this.context.editor === null ? null : new PulledPoint(this.context.scene, this.context.editor);

  activate(): void {
    this.hint.value = "Click selects. Drag turns the camera, or moves interactive objects.";
    this.stop = this.context.scene.onTick(() => this.hover());
  }

  deactivate(): void {
    this.stop?.();
    this.setHovered(null);
    this.context.hovered.value = null;
    this.dragged = null;
    if (this.pulled?.isPulling === true) this.pulled.end();
  }

  pointer(input: PointerInput): boolean {
    if (this.pulled?.isPulling === true) return this.pull(this.pulled, input);
    if (this.dragged !== null) return this.drag(this.dragged, input);
    if (input.kind === "move") this.waiting = input;
    else if (input.kind === "down") return this.press(input);
    else if (input.kind === "up" && input.button === 0) this.context.select(selectionOf(this.pressed));
    return false;
  }

  private press(input: PointerInput): boolean {
    if (input.control && input.button !== 1 && this.pulled?.begin(input) === true) return true;
    const event = this.eventOf(input);
    this.pressed = event.pick;
    const target = this.targetOf(event.pick);
    if (target?.down(event) !== true) return false;
    this.dragged = target;
    return true;
  }

  private pull(pulled: PulledPoint, input: PointerInput): boolean {
    if (input.kind === "move") pulled.move(input);
    else if (input.kind !== "down") pulled.end();
    return true;
  }

  private drag(target: PointerTarget, input: PointerInput): boolean {
    if (input.kind === "move") target.move({ ...this.eventOf(input), pick: null });
    if (input.kind === "up" || input.kind === "cancel") {
      this.dragged = null;
      target.up(this.eventOf(input), input.kind === "cancel");
    }
    return true;
  }

  /** Update the hovered object, once a frame, since picking takes a while in a large world. */
  private hover(): void {
    const input = this.waiting;
    this.waiting = null;
    if (input === null || input.button >= 0) return;
    const pick = this.context.scene.pick(input.x, input.y);
    this.setHovered(this.targetOf(pick));
    const selection = selectionOf(pick);
    this.context.hovered.value = selection?.kind === "link" ? selection : null;
  }

  /** Handlers of the picked object; null: none, or a view-only page. */
  private targetOf(pick: Pick | null): PointerTarget | null {
    return pick === null || this.context.viewOnly ? null : pointerTargetOf(pick.object);
  }

  private setHovered(target: PointerTarget | null): void {
    if (target === this.hoveredTarget) return;
    this.hoveredTarget?.hover(false);
    this.hoveredTarget = target;
    target?.hover(true);
  }

  private eventOf({ x, y, button, shift, control }: PointerInput): TargetEvent {
    const { scene } = this.context;
    return { x, y, ray: scene.ray(x, y), pick: scene.pick(x, y), button, shift, control };
  }
}
