/** rviz's MoveCamera: every drag moves the camera. */

import { BaseTool } from "./base_tool";

export class MoveCamera extends BaseTool {
  readonly className = "rviz/MoveCamera";
  readonly name = "Move Camera";
  readonly shortcut = "m";
  readonly icon = "camera_move";
  override readonly cursor = "default";

  activate(): void {
    this.hint.value = "Left: rotate. Middle: pan. Right or wheel: zoom. Shift: more options.";
  }

  deactivate(): void {
    // the tool has no state
  }

  pointer(): boolean {
    return false;
  }
}
