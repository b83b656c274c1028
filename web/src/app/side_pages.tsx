/** Pages of the side panels: the world and displays at the left; the selection, views and tools at the right. */

import type { ComponentType } from "preact";

import { DisplaysPage } from "./displays/displays_page";
import { InsertPage } from "./insert/page";
import { Inspector } from "./inspector/inspector";
import type { SideName, SidePage } from "./layout";
import { LessonPage } from "./lessons/lesson_page";
import type { Shell } from "./shell";
import { ToolsPage } from "./tools_page";
import { ViewsPage } from "./views/views_page";
import { canEdit } from "./world/edits";
import { WorldTree } from "./world/tree";

export interface SidePageInfo {
  readonly id: SidePage;
  readonly title: string;
  /** Short form where the row of tabs is narrow. */
  readonly short?: string;
  /** True: only where the world can be changed. */
  readonly edits?: true;
  readonly component: ComponentType<{ readonly shell: Shell }>;
}

const SIDE_PAGES: Readonly<Record<SideName, readonly SidePageInfo[]>> = {
  left: [
    { id: "world", title: "World", component: WorldTree },
    { id: "displays", title: "Displays", component: DisplaysPage },
    { id: "insert", title: "Insert", component: InsertPage, edits: true },
  ],
  right: [
    { id: "inspector", title: "Inspector", component: Inspector },
    { id: "views", title: "Views", component: ViewsPage },
    { id: "tool_properties", title: "Tool properties", short: "Tools", component: ToolsPage },
    { id: "lesson", title: "Lesson", component: LessonPage },
  ],
};

/** Pages of a side panel in this session. */
export function sidePages(shell: Shell, side: SideName): readonly SidePageInfo[] {
  return SIDE_PAGES[side].filter(
    ({ id, edits }) => (edits !== true || canEdit(shell)) && (id !== "lesson" || shell.lessons.isShown.value),
  );
}
