/** What this page is for, as `GET /session.json` says, and `trundle/session` as it changes (docs/decisions/0020). */

import { effect, signal, untracked, type ReadonlySignal } from "@preact/signals";

import type { Connection } from "../protocol/connection";

export interface Session {
  readonly title: string;
  readonly kind: "simulation" | "graph" | "log" | "bag";
  readonly version: string;
  readonly robot: string | null;
  /** `saved`: at the page, by `save_rviz_as`; else it was given at the start. */
  readonly rviz: {
    readonly name: string;
    readonly text: string;
    readonly writable: boolean;
    readonly saved: boolean;
  } | null;
  readonly fixed_frame: string | null;
  /** The namespace and remappings of the launch's rviz, in which the names of the file are. */
  readonly namespace: string;
  readonly remappings: Readonly<Record<string, string>>;
  /** Names of rqt programs whose panels open. */
  readonly panels: readonly string[];
  readonly plots: readonly string[];
  readonly images: readonly string[];
  readonly drive_topic: string | null;
  readonly sliders: readonly {
    readonly name: string;
    readonly lower: number;
    readonly upper: number;
    readonly position: number;
  }[];
  readonly joystick: boolean;
  /** Terminals of nodes; `ended` is a sentence on the node's end. */
  readonly terminals: readonly { readonly name: string; readonly ended: string | null }[];
  readonly foxglove: string;
  /** True: the server does nothing for this page that changes anything. */
  readonly view_only: boolean;
  /** Token of links that allow everything; null: this page only looks. */
  readonly token: string | null;
  /** Token of links that only allow looking. */
  readonly view_token: string;
  /** The page's node on the graph. */
  readonly node: string | null;
}

/** The session as it is now. A page of another kind is another page: `onOther` is called. */
export function liveSession(first: Session, connection: Connection, onOther: () => void): ReadonlySignal<Session> {
  const session = signal(first);
  connection.subscribeRaw("trundle/session", (payload) => {
    const next = JSON.parse(new TextDecoder().decode(payload)) as Session;
    if (next.kind !== first.kind || next.version !== first.version) onOther();
    else session.value = next;
  });
  return session;
}

/** Call a function for each item of a list, now and for those that come later; returns how to stop. */
export function forEachNew(items: () => readonly string[], act: (item: string) => void): () => void {
  const seen = new Set<string>();
  return effect(() => {
    const fresh = items().filter((item) => !seen.has(item));
    for (const item of fresh) seen.add(item);
    untracked(() => fresh.forEach(act));
  });
}
