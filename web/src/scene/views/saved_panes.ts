/** The panes of a split scene, as an .rviz file or a link keeps them. */

import { isMapping, type Yaml, type YamlMapping } from "../../rviz/properties";
import { PANE_LAYOUTS, type PaneLayout } from "../panes/pane_layout";
import type { Views } from "../view_controller";

/** YAML of the split, the active pane, and the views of all panes. */
export function savePanes({ layout, panes, active }: Pick<Views, "layout" | "panes" | "active">): YamlMapping {
  const shown = panes.value;
  return {
    Layout: layout.value,
    Active: shown.indexOf(active.value),
    Panes: shown.map((pane) => pane.current.value.save()),
  };
}

/** Saved layout; null: not saved. */
export function savedLayout(yaml: YamlMapping): PaneLayout | null {
  const layout = PANE_LAYOUTS.find((name) => name === yaml["Layout"]);
  return Array.isArray(yaml["Panes"]) ? (layout ?? null) : null;
}

/** Load the panes' views after the scene is split; returns faults. */
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
