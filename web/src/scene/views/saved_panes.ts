/** The panes of a split scene, as an .rviz file or a link keeps them. */

import { isMapping, type Yaml, type YamlMapping } from "../../rviz/properties";
import { PANE_LAYOUTS, type PaneLayout } from "../panes/pane_layout";
import type { Views } from "../view_controller";

/** How the scene is split, which pane is active, and the view of each. */
export function savePanes({ layout, panes, active }: Pick<Views, "layout" | "panes" | "active">): YamlMapping {
  const shown = panes.value;
  return {
    Layout: layout.value,
    Active: shown.indexOf(active.value),
    Panes: shown.map((pane) => pane.current.value.save()),
  };
}

/** How the scene is split by what was saved; null: that is none. */
export function savedLayout(yaml: YamlMapping): PaneLayout | null {
  const layout = PANE_LAYOUTS.find((name) => name === yaml["Layout"]);
  return Array.isArray(yaml["Panes"]) ? (layout ?? null) : null;
}

/** Give the panes, once the scene is split, their views; returns faults. */
export function loadPanes(views: Pick<Views, "panes" | "activate">, yaml: YamlMapping): readonly string[] {
  const saved = Array.isArray(yaml["Panes"]) ? (yaml["Panes"] as readonly Yaml[]) : [];
  const faults = views.panes.peek().flatMap((pane, index) => {
    const view = saved[index];
    return isMapping(view) ? pane.load(view) : [];
  });
  const active = views.panes.peek()[Number(yaml["Active"])];
  if (active !== undefined) views.activate(active);
  return faults;
}
