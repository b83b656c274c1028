/** Simulation or ROS time, real-time factor and speed. */

import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";

import { fixed, rosTime } from "../theme/format";
import { MenuButton } from "../theme/menu";
import { StatusShape } from "../theme/status_shape";
import { canControl } from "../page/looking";
import { simulates } from "./simulation_commands";
import type { Shell } from "./shell";

const SLOW = 0.9;
const SPEEDS: readonly (number | null)[] = [0.1, 0.5, 1, 2, null];
const REFRESH = 100; // ms

export function Clock({ shell }: { readonly shell: Shell }): JSX.Element {
  const { world, session } = shell.page;
  if (!simulates(shell.page)) return <RosTime shell={shell} />;
  const state = world.state.value;
  const factor = state === null || state.paused ? null : state.real_time_factor;
  return (
    <>
      <span class="read">
        <b>{state === null ? "—" : rosTime(BigInt(state.time_ns))}</b>
        <span class="of">{session.kind === "bag" ? "ROS time" : "sim time"}</span>
      </span>
      <Factor factor={factor} speed={state?.speed ?? null} />
      {!shell.layout.isPhone.value && state !== null && canControl(shell.page) && (
        <Speed shell={shell} speed={state.speed} />
      )}
    </>
  );
}

/** Real-time factor; slow when the world falls behind the requested speed. */
function Factor({ factor, speed }: { readonly factor: number | null; readonly speed: number | null }): JSX.Element {
  const slow = factor !== null && factor < SLOW * Math.min(1, speed ?? 1);
  return (
    <span class={slow ? "read rtf slow" : "read rtf"}>
      {slow && <StatusShape level="warn" label="Slower than the requested speed" />}
      <b>{factor === null ? "—" : `${fixed(factor, 2)}×`}</b>
      <span class="of">real time</span>
    </span>
  );
}

function speedText(speed: number | null): string {
  return speed === null ? "As fast as possible" : `${speed}×`;
}

function Speed({ shell, speed }: { readonly shell: Shell; readonly speed: number | null }): JSX.Element {
  const items = SPEEDS.map((factor) => ({
    title: speedText(factor),
    checked: factor === speed,
    run: () => shell.request("Speed", "speed", { factor }),
  }));
  return (
    <MenuButton items={() => items}>{speed === null ? "As fast as possible" : `Speed ${speedText(speed)}`}</MenuButton>
  );
}

function RosTime({ shell }: { readonly shell: Shell }): JSX.Element {
  const { connection } = shell.page;
  const [now, setNow] = useState(connection.now());
  const frozen = shell.frozen.value;
  useEffect(() => {
    if (frozen) return undefined;
    const timer = setInterval(() => setNow(connection.now()), REFRESH);
    return () => clearInterval(timer);
  }, [connection, frozen]);
  return (
    <span class="read">
      <b>{rosTime(now)}</b>
      <span class="of">ROS time</span>
    </span>
  );
}
