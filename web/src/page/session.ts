/** What this page is for, as it changes. */

import { effect, signal, untracked, type ReadonlySignal } from "@preact/signals";

import { readPayload, struct, text } from "../protocol/check";
import type { Connection } from "../protocol/connection";
import { pageSession } from "../protocol/generated/page_checks";
import type { PageSession } from "../protocol/generated/page_messages";

const TOPIC = "trundle/session";
/** What tells a page from another one, also where the page cannot read the rest. */
const identity = struct<{ readonly kind: string; readonly version: string }>(() => ({ kind: text, version: text }));

/** The session as it is now. A page of another kind is another page: `onOther` is called. */
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

/** Call a function for each item of a list, now and for those that come later; returns how to stop. */
export function forEachNew(items: () => readonly string[], act: (item: string) => void): () => void {
  const seen = new Set<string>();
  return effect(() => {
    const fresh = items().filter((item) => !seen.has(item));
    for (const item of fresh) seen.add(item);
    untracked(() => fresh.forEach(act));
  });
}
