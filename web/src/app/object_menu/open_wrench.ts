/** Opens the form of a force and a torque on a link in the Inspector. */

import type { Selection } from "../../page/page";
import type { Shell } from "../shell";
import { findModel } from "../../page/selection_lookup";

/** Select the link, or a model's first; its form takes the focus once it is drawn. */
export function openWrench(
  { page, layout, wrench }: Shell,
  selection: Extract<Selection, { kind: "model" | "link" }>,
): void {
  const { model } = selection;
  const link = selection.kind === "link" ? selection.link : findModel(page, model)?.links[0]?.name;
  if (link === undefined) return;
  page.selection.value = { kind: "link", model, link };
  wrench.value = { model, link };
  layout.open("inspector");
}
