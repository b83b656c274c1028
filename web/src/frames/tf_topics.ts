/** Feeds a tree of transforms from the topics of tf. */

import type { Connection, Received, Subscription } from "../protocol/connection";
import { GraphNames } from "../protocol/graph_names";
import type { TFMessage } from "../protocol/messages";
import type { TransformTree } from "./transform_tree";

/** Wall clocks are set back by less [ns]; simulations begin again at 0. */
const JUMP = 100_000_000n;

/**
 * Feed from /tf and /tf_static until the subscription is closed. When the time goes back, what moves is forgotten; in
 * a new connection, where all is sent again, everything.
 */
export function feedTransforms(tree: TransformTree, connection: Connection, names = new GraphNames()): Subscription {
  let last = connection.now();
  const receive = (isStatic: boolean) => (received: Received<TFMessage>) => {
    const now = connection.now();
    if (now < last - JUMP) tree.clearMoving();
    last = now;
    tree.add(received.message.transforms, isStatic);
  };
  const unwatch = connection.state.subscribe((state) => {
    if (state.kind !== "connected") return;
    tree.clear();
    last = connection.now();
  });
  const subscriptions = [
    connection.subscribe<TFMessage>(names.resolve("/tf_static"), receive(true), { every: true }),
    connection.subscribe<TFMessage>(names.resolve("/tf"), receive(false), { every: true }),
  ];
  return {
    close: () => {
      unwatch();
      for (const subscription of subscriptions) subscription.close();
    },
  };
}
