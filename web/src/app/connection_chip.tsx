/** The connection to the server, and how late the page is. */

import type { JSX } from "preact";

import type { ConnectionState, Lag } from "../protocol/connection";
import type { StatusLevel } from "../rviz/status_level";
import { count, fixed } from "../theme/format";
import { StatusShape } from "../theme/status_shape";
import type { Shell } from "./shell";

export function ConnectionChip({ shell }: { readonly shell: Shell }): JSX.Element {
  const { connection, session } = shell.page;
  const state = connection.state.value;
  const lag = connection.lag.value;
  const { publishers, subscribers, services } = connection.graph.value;
  const nodes = new Set([publishers, subscribers, services].flatMap((map) => [...map.values()].flat()));
  const text = connectionText(state, lag, session.kind === "graph" ? nodes.size : 0);
  const isWell = state.kind === "connected" && lag === null;
  const shown = shell.layout.isPhone.value && lag === null ? null : text;
  return (
    <span class="connection" role="status" {...(lag === null ? {} : { "data-tip": lagTip(lag) })}>
      <StatusShape level={levelOf(state, lag)} label={text} />
      {shown !== null && (
        <span class={isWell ? "fits" : ""} data-rank={isWell ? 5 : undefined} aria-hidden="true">
          {shown}
        </span>
      )}
    </span>
  );
}

function levelOf(state: ConnectionState, lag: Lag | null): StatusLevel {
  if (state.kind === "connected") return lag === null ? "ok" : "warn";
  return state.kind === "connecting" ? "none" : "error";
}

/** The connection's state in words. */
function connectionText(state: ConnectionState, lag: Lag | null, nodes: number): string {
  if (state.kind === "connecting") return "Connecting";
  if (state.kind === "lost")
    return `Connection lost, trying again${state.retryInSeconds > 0 ? ` in ${state.retryInSeconds} s` : ""}`;
  if (lag !== null) return `${fixed(lag.seconds, 1)} s behind`;
  return nodes > 0 ? `Connected · ${count(nodes, "node")}` : "Connected";
}

function lagTip({ since }: Lag): string {
  const time = new Date(since).toLocaleTimeString();
  return `Late since ${time}: the connection or this browser is slower than the data. Images and clouds come less often.`;
}
