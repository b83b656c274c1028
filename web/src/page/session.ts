/** The page's session, as it changes. */

import { effect, signal, untracked, type ReadonlySignal } from "@preact/signals";

import { readPayload, struct, text } from "../protocol/check";
import type { Connection } from "../protocol/connection";
import { pageSession } from "../protocol/generated/page_checks";
import type { PageSession } from "../protocol/generated/page_messages";

const TOPIC = "trundle/session";
/** Fields that identify a session, also if the page cannot read the rest. */
const identity = struct<{ readonly kind: string; readonly version: string }>(() => ({ kind: text, version: text }));

/** Current session; `onOther` is called when the server starts a session of another kind. */
export function liveSession(
  first: PageSession,
  connection: Connection,
  onOther: () => void,
): ReadonlySignal<PageSession> {
  const session = signal(first);
  connection.subscribeRaw(TOPIC, (payload) => {
    const { kind, version } = readPayload(payload, TOPIC, identity);
    if (kind !== first.kind || version !== first.version) onOther();
    else session.value = readPayload(payload, TOPIC, pageSession);
  });
  return session;
}

/** Call a function for each item of a list, now and for later items; returns a function that stops. */
export function forEachNew(items: () => readonly string[], act: (item: string) => void): () => void {
  const known = new Set<string>();
  return effect(() => {
    const fresh = items().filter((item) => !known.has(item));
    for (const item of fresh) known.add(item);
    untracked(() => fresh.forEach(act));
  });
}
