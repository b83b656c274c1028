/** The draft as the server describes it: a copy of a model that is edited. */

import type { SixNumbers } from "./simulated_world";

/** Tags and names from the model down: ["link", "base", "sensor", "eye"]; empty: the model itself. */
export type PartPath = readonly string[];
/** Numbers are null where one stays as it is; null: the default. */
export type FieldValue = string | readonly (number | null)[] | null;

export interface DraftField {
  readonly name: string;
  readonly label: string;
  readonly kind: "text" | "number" | "vector" | "pose" | "colour" | "choice" | "flag";
  /** Null: the file says nothing, and the default counts. */
  readonly value: string | readonly number[] | boolean | null;
  readonly default: string | readonly number[] | boolean | null;
  readonly unit?: string;
  /** Names of a vector's numbers. */
  readonly labels?: readonly string[];
  readonly choices?: readonly string[];
  readonly least?: number;
  readonly most?: number;
}

export interface DraftFinding {
  readonly severity: "error" | "warning";
  readonly text: string;
  readonly line: number | null;
}

export interface DraftPart {
  readonly part: PartPath;
  readonly tag: string;
  readonly name: string;
  /** Type, shape or file name. */
  readonly detail: string;
  /** Of a link [kg]. */
  readonly mass: number | null;
  /** Number of a link in the model; null: it is none. */
  readonly link: number | null;
  readonly line: number;
  readonly sections: readonly { readonly title: string; readonly fields: readonly DraftField[] }[];
  readonly findings: readonly DraftFinding[];
}

export interface Draft {
  readonly name: string;
  /** Model of the world that it takes the place of; null: it is a new one. */
  readonly of: string | null;
  /** Of the model in the world. */
  readonly pose: SixNumbers;
  readonly undo: string | null;
  readonly redo: string | null;
  /** Folder to save it in; null: nothing can be written. */
  readonly folder: string | null;
  readonly files: readonly { readonly id: string; readonly url: string }[];
  /** The model itself, then what is in it, in the file's order. */
  readonly parts: readonly DraftPart[];
}

/** Number of the draft's first link among the bodies of the scene. */
const FIRST_BODY = 65536;

/** The body that a part is drawn as; null: it is no link. */
export function bodyOf(part: DraftPart): number | null {
  return part.link === null ? null : FIRST_BODY + part.link;
}

export function isDraftBody(body: number): boolean {
  return body >= FIRST_BODY;
}

export function findPart(draft: Draft | null | undefined, path: PartPath): DraftPart | null {
  return draft?.parts.find(({ part }) => samePath(part, path)) ?? null;
}

export function samePath(a: PartPath, b: PartPath): boolean {
  return a.length === b.length && a.every((step, i) => step === b[i]);
}

/** The link that a part is or is on; null: it is on none. */
export function linkAround(path: PartPath): PartPath | null {
  for (let end = path.length; end > 0; end -= 2) if (path[end - 2] === "link") return path.slice(0, end);
  return null;
}

/** The address of a drawn link, whose name is `model::inner::link`. */
export function pathOfLink(name: string): PartPath {
  const scopes = name.split("::").slice(1);
  return scopes.flatMap((scope, i) => [i === scopes.length - 1 ? "link" : "model", scope]);
}

/** Bodies of a part: of a link its own, of a joint its child's, of the model all. */
export function bodiesOfPart(draft: Draft | null, path: PartPath): readonly number[] {
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
