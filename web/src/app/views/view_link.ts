/** Links that keep the view: behind the page's address stands from where one looks. */

import { isMapping, type Yaml, type YamlMapping } from "../../rviz/properties";
import type { Views } from "../../scene/view_controller";

const KEY = "#view=";
/** Longest text of a view [characters]. */
const LONGEST = 4000;

/** The page's address with the current view; with a token, another address of the page. */
export function linkTo(views: Pick<Views, "current">, address: string, token: string | null = null): string {
  const short = (_: string, value: unknown): unknown => (typeof value === "number" ? Number(value.toPrecision(6)) : value);
  const url = new URL(address);
  url.hash = "";
  if (token !== null) url.searchParams.set("token", token);
  return `${url.href}${KEY}${encodeURIComponent(JSON.stringify(views.current.peek().save(), short))}`;
}

/** The view that a link's end holds, as an .rviz file would; null: none that can be read. */
export function linkedView(hash: string): YamlMapping | null {
  if (!hash.startsWith(KEY) || hash.length > LONGEST) return null;
  try {
    const view = JSON.parse(decodeURIComponent(hash.slice(KEY.length))) as Yaml;
    return isMapping(view) ? view : null;
  } catch {
    return null;
  }
}
