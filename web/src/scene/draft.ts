/** Parts of the draft, a copy of a model that is edited. */

import type { DraftInfo, DraftPart } from "../protocol/generated/page_messages";

/** Tags and names from the model down: ["link", "base", "sensor", "eye"]; empty: the model itself. */
export type PartPath = readonly string[];
/** Value of a field; null: the default; a null in a list leaves that number unchanged. */
export type FieldValue = string | readonly (number | null)[] | null;

/** Number of the draft's first link among the bodies of the scene. */
const FIRST_BODY = 65536;

/** The body that is drawn for a part; null: the part is no link. */
function bodyOf(part: DraftPart): number | null {
  return part.link === null ? null : FIRST_BODY + part.link;
}

export function isDraftBody(body: number): boolean {
  return body >= FIRST_BODY;
}

export function findPart(draft: DraftInfo | null | undefined, path: PartPath): DraftPart | null {
  return draft?.parts.find(({ part }) => samePath(part, path)) ?? null;
}

function samePath(a: PartPath, b: PartPath): boolean {
  return a.length === b.length && a.every((step, i) => step === b[i]);
}

/** The part itself if it is a link, else the link that it is on; null: it is on no link. */
export function linkAround(path: PartPath): PartPath | null {
  for (let end = path.length; end > 0; end -= 2) if (path[end - 2] === "link") return path.slice(0, end);
  return null;
}

/** The address of a drawn link, whose name is `model::inner::link`. */
export function pathOfLink(name: string): PartPath {
  const scopes = name.split("::").slice(1);
  return scopes.flatMap((scope, i) => [i === scopes.length - 1 ? "link" : "model", scope]);
}

/** Bodies of a part: for a link its body, for a joint its child's body, for the model all bodies. */
export function bodiesOfPart(draft: DraftInfo | null, path: PartPath): readonly number[] {
  if (draft === null) return [];
  const all = draft.parts.flatMap((part) => bodyOf(part) ?? []);
  if (path.length === 0) return all;
  const part = findPart(draft, path);
  if (part?.tag === "joint") {
    const child = part.sections.flatMap(({ fields }) => fields).find(({ name }) => name === "child")?.value;
    return typeof child === "string" ? bodiesOfPart(draft, [...path.slice(0, -2), "link", child]) : [];
  }
  for (let end = path.length; end > 0; end -= 2) {
    const around = findPart(draft, path.slice(0, end));
    const body = around === null ? null : bodyOf(around);
    if (body !== null) return [body];
  }
  return [];
}
