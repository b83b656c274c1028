/** rviz's FocusCamera: turns the camera to the clicked point. */

import { BaseTool } from "./base_tool";
import type { PointerInput } from "../scene/pointer_input";

export class FocusCamera extends BaseTool {
  readonly className = "rviz/FocusCamera";
  readonly name = "Focus Camera";
  readonly shortcut = "c";
  readonly icon = "focus";

  activate(): void {
    this.hint.value = "Click the point to look at.";
  }

  deactivate(): void {
    // the tool has no state
  }

  pointer({ kind, button, x, y }: PointerInput): boolean {
    if (kind !== "down" || button !== 0) return kind !== "down";
    const { scene, views } = this.context;
    const point = scene.pick(x, y)?.point ?? scene.pickGround(x, y);
    if (point === null) return false;
    views.focus(point);
    this.finish();
    return true;
  }
}
