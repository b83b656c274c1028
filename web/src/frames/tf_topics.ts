/** Feeds a tree of transforms from the topics of tf. */

import type { Connection, Received, Subscription } from "../protocol/connection";
import { GraphNames } from "../protocol/graph_names";
import type { TFMessage } from "../protocol/generated/ros_messages";
import type { TransformTree } from "./transform_tree";

/** Smallest jump back that counts as a restart [ns]: wall clocks are set back by less. */
const JUMP = 100_000_000n;

/**
 * Feed from /tf and /tf_static until the subscription is closed. When time goes back, all but static transforms are
 * dropped; on a new connection, which sends all again, every transform.
 *
 * Time is read from /tf's own messages: decoding takes a while, so the clock may have gone back before the last of them
 * arrives, and messages of /tf_static may be of any age.
 */
export function feedTransforms(tree: TransformTree, connection: Connection, names = new GraphNames()): Subscription {
  let last = 0n;
  const receive = ({ message, time }: Received<TFMessage>): void => {
    if (time < last - JUMP) tree.clearMoving();
    last = time;
    tree.add(message.transforms, false);
  };
  const unwatch = connection.state.subscribe((state) => {
    if (state.kind !== "connected") return;
    tree.clear();
    last = 0n;
  });
  const subscriptions = [
    connection.subscribe<TFMessage>(names.resolve("/tf_static"), ({ message }) => tree.add(message.transforms, true), {
      every: true,
    }),
    connection.subscribe<TFMessage>(names.resolve("/tf"), receive, { every: true }),
  ];
  return {
    close: () => {
      unwatch();
      for (const subscription of subscriptions) subscription.close();
    },
  };
}
