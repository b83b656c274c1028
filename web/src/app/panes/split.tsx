/** How the scene is split: chosen in a menu or by commands, remembered; a phone has one pane. */

import { effect, signal, type Signal } from "@preact/signals";
import type { JSX } from "preact";

import { PANE_LAYOUTS, type PaneLayout } from "../../scene/panes/pane_layout";
import { MenuButton } from "../../theme/menu";
import type { Command, Page } from "../../page/page";
import type { Layout } from "../layout";
import type { Shell } from "../shell";
import { isOneOf, recall, remember } from "../../page/storage";

const TITLES: Readonly<Record<PaneLayout, string>> = {
  one: "One view",
  beside: "Two views side by side",
  stacked: "Two views, stacked",
  four: "Four views",
};

/** The remembered layout, which the scene has unless the page is a phone's. */
export function recallSplit({ views }: Pick<Page, "views">, layout: Layout): Signal<PaneLayout> {
  const split = signal(recall<PaneLayout>("split", "one", isOneOf(...PANE_LAYOUTS)));
  views.onFileLayout = (asked) => {
    split.value = asked;
  };
  effect(() => {
    views.layout.value = layout.isPhone.value ? "one" : split.value;
  });
  return split;
}

/** Split the scene as a person chooses, which is remembered; what a link shows is not. */
export function chooseSplit(split: Signal<PaneLayout>, layout: PaneLayout): void {
  split.value = layout;
  remember("split", layout);
}

export function SplitMenu({ shell }: { readonly shell: Shell }): JSX.Element {
  const items = (): ReturnType<Parameters<typeof MenuButton>[0]["items"]> =>
    PANE_LAYOUTS.map((layout) => ({
      title: TITLES[layout],
      checked: shell.split.value === layout,
      run: () => chooseSplit(shell.split, layout),
    }));
  return (
    <div class="tools float">
      <MenuButton icon="panes" label="Split the view" items={items} />
    </div>
  );
}

export function splitCommands({ page, split, layout }: Shell): readonly Command[] {
  const isSplit = (): boolean => page.views.panes.peek().length > 1;
  return [
    ...PANE_LAYOUTS.map(
      (each): Command => ({
        id: `split.${each}`,
        group: "View",
        title: TITLES[each],
        enabled: () => !layout.isPhone.peek(),
        run: () => chooseSplit(split, each),
      }),
    ),
    {
      id: "pane.next",
      group: "View",
      title: "Next of the views",
      keys: "V",
      enabled: isSplit,
      run: () => page.views.stepPane(1),
    },
    {
      id: "pane.previous",
      group: "View",
      title: "View before",
      keys: "Shift V",
      enabled: isSplit,
      run: () => page.views.stepPane(-1),
    },
  ];
}
