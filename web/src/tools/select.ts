/** rviz's Select: selects by a click or a box; the Inspector shows the picked fields. */

import { BaseTool } from "./base_tool";
import { selectionOf, selectionOfAll } from "./picked";
import type { PointerInput } from "../scene/pointer_input";

/** Smaller boxes are clicks [px]. */
const CLICK = 4;
const MAX_PICKED = 500;

export class Select extends BaseTool {
  readonly className = "rviz/Select";
  readonly name = "Select";
  readonly shortcut = "s";
  readonly icon = "box";
  private start: PointerInput | null = null;
  private readonly rubberBand = document.createElement("div");

  activate(): void {
    this.hint.value = "Click, or drag a box.";
    const style =
      "position: absolute; pointer-events: none; border: 1px dashed var(--accent); background: var(--accent-soft)";
    this.rubberBand.setAttribute("style", style);
  }

  deactivate(): void {
    this.start = null;
    this.rubberBand.remove();
  }

  pointer(input: PointerInput): boolean {
    if (input.kind === "down") {
      if (input.button !== 0) return false;
      this.start = input;
      return true;
    }
    if (this.start === null) return false;
    if (input.kind === "move") this.draw(this.start, input);
    else {
      if (input.kind === "up") this.select(this.start, input);
      this.start = null;
      this.rubberBand.remove();
    }
    return true;
  }

  private select(from: PointerInput, to: PointerInput): void {
    const { scene, select } = this.context;
    const box = boxOf(from, to);
    const isClick = box.right - box.left < CLICK && box.bottom - box.top < CLICK;
    select(isClick ? selectionOf(scene.pick(to.x, to.y)) : selectionOfAll(scene.pickBox(box, MAX_PICKED)));
  }

  private draw(from: PointerInput, to: PointerInput): void {
    const { left, top, right, bottom } = boxOf(from, to);
    Object.assign(this.rubberBand.style, {
      left: `${left}px`,
      top: `${top}px`,
      width: `${right - left}px`,
      height: `${bottom - top}px`,
    });
    if (this.rubberBand.parentElement === null) this.context.scene.element.parentElement?.append(this.rubberBand);
  }
}

function boxOf(a: PointerInput, b: PointerInput): { left: number; top: number; right: number; bottom: number } {
  return { left: Math.min(a.x, b.x), top: Math.min(a.y, b.y), right: Math.max(a.x, b.x), bottom: Math.max(a.y, b.y) };
}
