/** Simulation or ROS time, real-time factor and speed. */

import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";

import { FittingPart } from "../theme/fitting_row";
import { fixed, rosTime } from "../theme/format";
import { MenuButton } from "../theme/menu";
import type { MenuItem } from "../theme/menu_list";
import { StatusShape } from "../theme/status_shape";
import { canControl } from "../page/view_only";
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
        <Unit text={session.kind === "bag" ? "ROS time" : "sim time"} />
      </span>
      <Factor factor={factor} speed={state?.speed ?? null} />
      {!shell.layout.isPhone.value && state !== null && canControl(shell.page) && (
        <FittingPart rank={10} part="speed">
          <MenuButton items={() => speedItems(shell, state.speed)}>{speedText(state.speed, "Speed ")}</MenuButton>
        </FittingPart>
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
      <Unit text="real time" />
    </span>
  );
}

/** Unit of a number of the bar; a narrow bar drops it first. */
function Unit({ text }: { readonly text: string }): JSX.Element {
  return (
    <FittingPart rank={2}>
      <span class="of">{text}</span>
    </FittingPart>
  );
}

function speedText(speed: number | null, prefix = ""): string {
  return speed === null ? "As fast as possible" : `${prefix}${speed}×`;
}

export function speedItems(shell: Shell, speed: number | null): readonly MenuItem[] {
  return SPEEDS.map((factor) => ({
    title: speedText(factor),
    checked: factor === speed,
    run: () => shell.request("Speed", "speed", { factor }),
  }));
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
      <Unit text="ROS time" />
    </span>
  );
}
