/** The newest message of a topic as a tree. */

import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";

import type { Connection, Received } from "../../protocol/connection";
import type { RosMessage } from "../../protocol/ros_types";
import { MessageTree } from "../messages/message_tree";

const PERIOD = 100; // ms: nobody reads faster

export function TopicEcho({
  connection,
  topic,
}: {
  readonly connection: Connection;
  readonly topic: string;
}): JSX.Element {
  const [received, setReceived] = useState<Received<RosMessage> | null>(null);
  const [fault, setFault] = useState("");
  useEffect(() => {
    let newest: Received<RosMessage> | null = null;
    let timer: ReturnType<typeof setTimeout> | undefined;
    setReceived(null);
    setFault("");
    const show = (): void => {
      timer = undefined;
      setReceived(newest);
    };
    const subscription = connection.subscribe(
      topic,
      (one) => {
        newest = one;
        timer ??= setTimeout(show, PERIOD);
      },
      { onError: setFault },
    );
    return () => {
      clearTimeout(timer);
      subscription.close();
    };
  }, [connection, topic]);
  if (fault !== "")
    return (
      <div class="fault pad" role="alert">
        {fault}
      </div>
    );
  if (received === null) return <div class="empty">No message yet.</div>;
  return <MessageTree label={`Message of ${topic}`} type={received.type} message={received.message} />;
}
