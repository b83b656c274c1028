/** Commands that insert a model, a light or a shape. */

import type { Command } from "../../page/page";
import type { Shell } from "../shell";
import { canEdit } from "../world/edits";

/** Commands with keys while an item follows the pointer. */
export function insertionCommands(shell: Shell): readonly Command[] {
  const { insert } = shell.page.tools;
  if (insert === null || !canEdit(shell)) return [];
  const command = (id: string, title: string, keys: string, run: () => void): Command => ({
    id,
    title,
    group: "Tools",
    keys,
    enabled: () => insert.chosen.peek() !== null,
    run,
  });
  return [
    { id: "upload_model", title: "Upload a model", group: "Simulation", run: () => shell.insertion.upload.open() },
    command("insert.place", "Insert in the center of the view", "Enter", () => insert.placeInMiddle()),
    command("insert.leave", "Cancel the insertion", "Escape", () => shell.page.tools.use("rviz/Interact")),
  ];
}
