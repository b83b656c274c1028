/** Feeds a tree of transforms from the topics of tf. */

import type { Connection, Received, Subscription } from "../protocol/connection";
import { GraphNames } from "../protocol/graph_names";
import type { TFMessage } from "../protocol/generated/ros_messages";
import type { TransformTree } from "./transform_tree";

/** Smallest jump back that counts as a restart [ns]: wall clocks are set back by less. */
const JUMP = 100_000_000n;

/**
 * Feed from /tf and /tf_static until the subscription is closed. When the time goes back, what moves is forgotten; in
 * a new connection, where all is sent again, everything.
 *
 * The time is that of /tf's own messages: decoding takes a while, so that the clock may be back before the last of them
 * came, and those of /tf_static are as old as they are.
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
