/** The remembered split of the scene; a phone has one pane. */

import { effect, signal, type Signal } from "@preact/signals";

import { PANE_LAYOUTS, type PaneLayout } from "../../scene/panes/pane_layout";
import type { Page } from "../../page/page";
import { isOneOf, recall, remember } from "../../page/storage";
import type { Layout } from "../layout";

/** The remembered layout, which the scene has unless the page is a phone's. */
export function recallSplit({ views }: Pick<Page, "views">, layout: Layout): Signal<PaneLayout> {
  const split = signal(recall<PaneLayout>("split", "one", isOneOf(...PANE_LAYOUTS)));
  views.onFileLayout = (fileLayout) => {
    split.value = fileLayout;
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
