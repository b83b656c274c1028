/** Commands of the page: its panels, the view, undo. */

import { toggleFirstPerson } from "./views/first_person";
import { toggleFollowing } from "./views/following";
import { frameSelection } from "./views/framing";
import { canControl } from "../page/view_only";
import { chooseRviz } from "./dialogs/open_files";
import type { Command } from "../page/page";
import { download, rvizFile, save } from "./displays/rviz_foot";
import type { Shell } from "./shell";
import { sidePages } from "./side_pages";
import { switchTheme } from "./theme";

const SIDES = ["front", "back", "left", "right", "top", "bottom"] as const;

function command(id: string, group: Command["group"], title: string, run: () => void, keys?: string): Command {
  return keys === undefined ? { id, group, title, run } : { id, group, title, run, keys };
}

/** Commands that open the available panels. */
export function panelCommands({ dock }: Shell): readonly Command[] {
  return dock.panels
    .peek()
    .map(({ id, title }) => command(`panel.${id}`, "Panels", `Open ${title}`, () => dock.open(id)));
}

/** Commands of the 3D view. */
export function viewCommands({ page, dialog, videos }: Shell): readonly Command[] {
  const { views } = page;
  return [
    command("frame", "View", "Frame the selection", () => frameSelection(page, page.selection.peek()), "F"),
    command("follow", "View", "Follow the selection, or stop", () => toggleFollowing(page), "Shift F"),
    command("projection", "View", "Perspective or orthographic", () => views.toggleProjection()),
    command("first_person", "View", "First person from the selection, or the robot", () => toggleFirstPerson(page)),
    command("picture", "View", "Save a picture of the view", () => (dialog.value = "picture")),
    command("video", "View", "Record a video of the view, or stop", () => videos.toggleView()),
    ...SIDES.map((side) =>
      command(`look.${side}`, "View", `Look from ${/top|bottom/.test(side) ? side : `the ${side}`}`, () =>
        views.lookFrom(side),
      ),
    ),
  ];
}

export function pageCommands(shell: Shell): readonly Command[] {
  const { page, layout, dialog } = shell;
  const { undo } = page;
  const toggle = (open: { value: boolean; peek(): boolean }) => () => {
    open.value = !open.peek();
  };
  return [
    command("deselect", "View", "Clear the selection, close large pictures", () => leave(shell), "Escape"),
    command("cameras", "View", "Show or hide the cameras", toggle(shell.showsCameras)),
    command("lessons", "Page", "Lessons", () => shell.lessons.toggle()),
    command("share", "Page", "Share", () => (dialog.value = "share")),
    ...[...sidePages(shell, "left"), ...sidePages(shell, "right")].map(({ id, title }) =>
      command(`side.${id}`, "Panels", `Open ${title}`, () => layout.open(id)),
    ),
    command("left.toggle", "Panels", "Show or hide the left panel", () => layout.toggle("left"), "["),
    command("right.toggle", "Panels", "Show or hide the right panel", () => layout.toggle("right"), "]"),
    command("dock.toggle", "Panels", "Show or hide the dock", () => layout.openDock(!layout.dockOpen.peek()), "\\"),
    { ...command("undo", "Page", "Undo", () => undo.undo(), "Ctrl Z"), enabled: () => undo.undoTitle.peek() !== null },
    {
      ...command("redo", "Page", "Redo", () => undo.redo(), "Ctrl Shift Z"),
      enabled: () => undo.redoTitle.peek() !== null,
    },
    command("open_rviz", "Displays", "Open an .rviz file", () => chooseRviz(shell)),
    {
      ...command("save_rviz", "Displays", "Save the .rviz file", () => save(shell)),
      enabled: () => rvizFile(shell)?.writable === true && canControl(page),
    },
    {
      ...command("save_rviz_as", "Displays", "Save as .rviz", () => (dialog.value = "save")),
      enabled: () => canControl(page),
    },
    command("download_rviz", "Displays", "Download as .rviz", () => download(shell)),
    command("reset_displays", "Displays", "Reset all displays", () => page.displays.reset()),
    command("theme", "Page", "Light or dark theme", () => switchTheme(page.theme)),
    command("notices", "Page", "Show the problems", () => (dialog.value = "notices")),
    command("palette", "Page", "Search commands", () => (dialog.value = "palette"), "Ctrl K"),
    command("help", "Page", "Keys", () => (dialog.value = "help"), "?"),
  ];
}

/** Close enlarged cameras; with none, clear the selection. */
function leave({ page, enlarged }: Shell): void {
  if (enlarged.peek().size > 0) enlarged.value = new Set();
  else page.selection.value = null;
}
