/** Pulls the pressed body by a spring to the pointer, as MuJoCo's viewer does. */

import { BaseTool, type ToolContext } from "./base_tool";
import { PulledPoint } from "./handles/pulled_point";
import type { PointerInput } from "../scene/pointer_input";
import type { WorldEditor } from "../page/world_editor";

export class PushModel extends BaseTool {
  readonly className = "trundle/Push";
  readonly name = "Push";
  readonly shortcut = "b";
  readonly icon = "push";
  private readonly pulled: PulledPoint;

  constructor(
    context: ToolContext,
    finish: () => void,
    private readonly editor: WorldEditor,
  ) {
    super(context, finish);
    this.pulled = new PulledPoint(context.scene, editor);
  }

  activate(): void {
    this.hint.value = "Press a part and drag: a spring pulls it to the pointer while the simulation runs.";
  }

  deactivate(): void {
    if (this.pulled.isPulling) this.pulled.end();
  }

  pointer(input: PointerInput): boolean {
    if (input.kind === "down") return input.button === 0 && this.press(input);
    if (!this.pulled.isPulling) return false;
    if (input.kind === "move") this.pulled.move(input);
    else {
      this.pulled.end();
      this.activate();
    }
    return true;
  }

  private press(input: PointerInput): boolean {
    if (!this.pulled.begin(input)) return false;
    if (this.editor.world.state.peek()?.paused === true) this.hint.value = "Paused: it moves once the simulation runs.";
    return true;
  }
}
