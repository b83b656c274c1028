/** A connection whose messages can be held back: "Freeze view". */

import { effect, type ReadonlySignal } from "@preact/signals";

import type { Connection, Received, Subscription } from "../protocol/connection";
import type { RosMessage } from "../protocol/ros_types";

/** Longest buffer of one subscription [messages]; of streams only the newest few are useful. */
const MAX_BUFFERED = 20;
const MAX_BUFFERED_EVERY = 5000;

/** Connection whose time stops and whose messages are buffered while `frozen`. */
export function freezable(connection: Connection, frozen: ReadonlySignal<boolean>): Connection {
  let stoppedAt: bigint | null = null;
  effect(() => {
    stoppedAt = frozen.value ? connection.now() : null;
  });
  const overrides: Pick<Connection, "now" | "subscribe"> = {
    now: () => stoppedAt ?? connection.now(),
    subscribe: <M = RosMessage>(
      topic: string,
      onMessage: (received: Received<M>) => void,
      options = {},
    ): Subscription => {
      const { every = false } = options as { readonly every?: boolean };
      let buffered: Received<M>[] = [];
      const release = effect(() => {
        if (frozen.value) return;
        const waiting = buffered;
        buffered = [];
        for (const received of waiting) onMessage(received);
      });
      const take = (received: Received<M>): void => {
        if (!frozen.peek()) {
          onMessage(received);
          return;
        }
        buffered.push(received);
        if (buffered.length > (every ? MAX_BUFFERED_EVERY : MAX_BUFFERED)) buffered.shift();
      };
      const inner = connection.subscribe(topic, take, options);
      return {
        close: () => {
          release();
          inner.close();
        },
      };
    },
  };
  return new Proxy(connection, {
    get: (target, name) => {
      if (name === "now" || name === "subscribe") return overrides[name];
      const value: unknown = Reflect.get(target, name, target);
      return typeof value === "function" ? (value.bind(target) as unknown) : value;
    },
  });
}
