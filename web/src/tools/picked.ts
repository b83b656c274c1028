/** Selection of a pick: a link of the simulated world, or an object that a display drew. */

import type { Object3D } from "three";

import type { Selection } from "../page/page";
import { isDraftBody, pathOfLink } from "../scene/draft";
import { SELECTABLE } from "../scene/box_picking";
import type { Pick, PointerTarget, Selectable } from "../scene/scene_view";

export function selectionOf(pick: Pick | null): Selection | null {
  if (pick === null) return null;
  for (let at: Object3D | null = pick.object; at !== null; at = at.parent) {
    const selectable = at.userData[SELECTABLE] as Selectable | undefined;
    if (selectable !== undefined) return { kind: "picked", title: nameOf(at), fields: selectable.describe(pick.index) };
    const body: unknown = at.userData["body"];
    if (typeof body === "number")
      return isDraftBody(body)
        ? { kind: "part", part: pathOfLink(String(at.userData["name"])) }
        : linkOf(String(at.userData["name"]));
  }
  return null;
}

/** Name of an object, otherwise of its nearest named ancestor: the display's. */
function nameOf(object: Object3D): string {
  for (let at: Object3D | null = object; at !== null; at = at.parent) if (at.name !== "") return at.name;
  return "Selection";
}

/** One selection of several picks; links of the world only where nothing else is picked. */
export function selectionOfAll(picks: readonly Pick[]): Selection | null {
  const selections = picks.flatMap((pick) => selectionOf(pick) ?? []);
  const drawn = selections.filter((selection) => selection.kind === "picked");
  if (drawn.length === 0) return selections[0] ?? null;
  const [first] = drawn;
  if (drawn.length === 1 && first !== undefined) return first;
  const fields = Object.fromEntries(drawn.map(({ title, fields }, index) => [`${title} ${index + 1}`, fields]));
  return { kind: "picked", title: `${drawn.length} selected`, fields };
}

/** The handlers of an object or of one above it. */
export function pointerTargetOf(object: Object3D): PointerTarget | null {
  for (let at: Object3D | null = object; at !== null; at = at.parent) {
    const target = at.userData["pointerTarget"] as PointerTarget | undefined;
    if (target !== undefined) return target;
  }
  return null;
}

/** The link of a body's name, `model::link`. */
function linkOf(name: string): Selection {
  const at = name.lastIndexOf("::");
  return { kind: "link", model: name.slice(0, Math.max(0, at)), link: name.slice(at < 0 ? 0 : at + 2) };
}
