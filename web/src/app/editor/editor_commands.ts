/** Commands of the model editor. */

import type { Command } from "../../page/page";
import type { Shell } from "../shell";
import { canEdit } from "../world/edits";
import type { PartPath } from "../../scene/draft";

export function editorCommands(shell: Shell): readonly Command[] {
  if (!canEdit(shell)) return [];
  const { editor, page } = shell;
  const isOpen = (): boolean => editor.draft.peek() !== null;
  const part = (): PartPath | null => {
    const selection = page.selection.peek();
    return selection?.kind === "part" && selection.part.length > 0 ? selection.part : null;
  };
  const model = (): string | null => {
    const selection = page.selection.peek();
    return selection?.kind === "model" || selection?.kind === "link" || selection?.kind === "joint"
      ? selection.model
      : null;
  };
  const command = (id: string, title: string, enabled: () => boolean, run: () => void, keys?: string): Command => ({
    id,
    title,
    group: "Simulation",
    ...(keys === undefined ? {} : { keys }),
    enabled,
    run,
  });
  return [
    command(
      "new_model",
      "New model…",
      () => !isOpen(),
      () => void editor.begin(null),
    ),
    command(
      "edit_model",
      "Edit the selected model…",
      () => !isOpen() && model() !== null,
      () => void editor.begin(model()),
    ),
    command("save_model", "Save the edited model…", isOpen, () => (shell.dialog.value = "save_model")),
    command("finish_model", "Put the edited model into the world", isOpen, () => void editor.finish()),
    command("leave_model", "Leave the model editor", isOpen, () => editor.leave()),
    command(
      "copy_part",
      "Copy the selected part",
      () => part() !== null,
      () => void editor.copy(part() ?? []),
      "Shift C",
    ),
    command(
      "delete_part",
      "Delete the selected part",
      () => part() !== null,
      () => void editor.remove(part() ?? []),
      "Delete",
    ),
  ];
}
