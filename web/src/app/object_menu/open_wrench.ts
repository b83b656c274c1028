/** The form of a force and a torque on a link, opened in the Inspector. */

import type { Selection } from "../../page/page";
import type { Shell } from "../shell";
import { findModel } from "../../page/selection_lookup";

/** Select the link, or a model's first, and go to the form's first field. */
export function openWrench({ page, layout }: Shell, selection: Extract<Selection, { kind: "model" | "link" }>): void {
  const { model } = selection;
  const link = selection.kind === "link" ? selection.link : findModel(page, model)?.links[0]?.name;
  if (link === undefined) return;
  page.selection.value = { kind: "link", model, link };
  layout.open("inspector");
  requestAnimationFrame(() => document.querySelector<HTMLElement>('[aria-label="force x"]')?.focus()); // once it is drawn
}
