/** Links that keep the view, in the fragment of the page's address. */

import type { Signal } from "@preact/signals";

import { parseJson } from "../../protocol/json";
import type { PaneLayout } from "../../scene/panes/pane_layout";
import { isMapping, type YamlMapping } from "../../rviz/properties";
import type { Views } from "../../scene/view_controller";
import { loadPanes, savedLayout, savePanes } from "../../scene/views/saved_panes";

const KEY = "#view=";
/** Longest text of a view [characters]. */
const LONGEST = 8000;

/** The link to the page with the current view, or the views of all panes. */
export function linkTo(
  views: Pick<Views, "current" | "layout" | "panes" | "active">,
  address: string,
  token: string,
): string {
  const short = (_: string, value: unknown): unknown =>
    typeof value === "number" ? Number(value.toPrecision(6)) : value;
  const url = new URL(address);
  url.hash = "";
  url.searchParams.delete("view_only");
  url.searchParams.set("token", token);
  return `${url.href}${KEY}${encodeURIComponent(JSON.stringify(shownViews(views), short))}`;
}

/** Origins at which other devices reach the page, the best first: that of this browser, if it is not loopback's. */
export function shareableOrigins(
  { origin, hostname }: Pick<Location, "origin" | "hostname">,
  networkUrls: readonly string[],
): readonly string[] {
  const isLocal = hostname === "localhost" || hostname === "[::1]" || hostname.startsWith("127.");
  return [...new Set([...(isLocal ? [] : [origin]), ...networkUrls])];
}

/** View in a link's fragment, as in an .rviz file; null: no readable view. */
export function linkedView(hash: string): YamlMapping | null {
  if (!hash.startsWith(KEY) || hash.length > LONGEST) return null;
  try {
    const view = parseJson(decodeURIComponent(hash.slice(KEY.length)));
    return isMapping(view) ? view : null;
  } catch {
    return null;
  }
}

/** The current view, or the views of several panes. */
function shownViews(views: Pick<Views, "current" | "layout" | "panes" | "active">): YamlMapping {
  return views.layout.peek() === "one" ? views.current.peek().save() : savePanes(views);
}

/** Show a link's view in the active pane, or its views in several panes. */
export function showLinkedView(views: Views, split: Signal<PaneLayout>, linked: YamlMapping): void {
  const layout = savedLayout(linked);
  split.value = layout ?? "one";
  if (layout === null) views.load({ Current: linked, Saved: views.save()["Saved"] ?? null });
  else loadPanes(views, linked);
}
