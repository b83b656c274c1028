/** Menu and commands that split the scene. */

import type { JSX } from "preact";

import { PANE_LAYOUTS, type PaneLayout } from "../../scene/panes/pane_layout";
import { MenuButton } from "../../theme/menu";
import type { Command } from "../../page/page";
import type { Shell } from "../shell";
import { chooseSplit } from "./remembered_split";

const TITLES: Readonly<Record<PaneLayout, string>> = {
  one: "One view",
  beside: "Two views side by side",
  stacked: "Two views, stacked",
  four: "Four views",
};

export function SplitMenu({ shell }: { readonly shell: Shell }): JSX.Element {
  const items = (): ReturnType<Parameters<typeof MenuButton>[0]["items"]> =>
    PANE_LAYOUTS.map((layout) => ({
      title: TITLES[layout],
      checked: shell.split.value === layout,
      run: () => chooseSplit(shell.split, layout),
    }));
  return <MenuButton icon="panes" label="Split the view" items={items} />;
}

export function splitCommands({ page, split, layout }: Shell): readonly Command[] {
  const isSplit = (): boolean => page.views.panes.peek().length > 1;
  return [
    ...PANE_LAYOUTS.map(
      (paneLayout): Command => ({
        id: `split.${paneLayout}`,
        group: "View",
        title: TITLES[paneLayout],
        enabled: () => !layout.isPhone.peek(),
        run: () => chooseSplit(split, paneLayout),
      }),
    ),
    {
      id: "pane.next",
      group: "View",
      title: "Next view",
      keys: "V",
      enabled: isSplit,
      run: () => page.views.stepPane(1),
    },
    {
      id: "pane.previous",
      group: "View",
      title: "Previous view",
      keys: "Shift V",
      enabled: isSplit,
      run: () => page.views.stepPane(-1),
    },
  ];
}
