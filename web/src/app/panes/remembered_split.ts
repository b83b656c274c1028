/** The remembered split of the scene; a phone has one pane. */

import { effect, signal, type Signal } from "@preact/signals";

import { PANE_LAYOUTS, type PaneLayout } from "../../scene/panes/pane_layout";
import type { Page } from "../../page/page";
import { isOneOf, recall, remember } from "../../page/storage";
import type { Layout } from "../layout";

/** Signal with the remembered layout; the scene of a phone's page has one pane. */
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

/** Set the layout that a person chose, and remember it; a link's layout is not remembered. */
export function chooseSplit(split: Signal<PaneLayout>, layout: PaneLayout): void {
  split.value = layout;
  remember("split", layout);
}
