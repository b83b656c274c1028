/** Dialog for several steps at once, or for a time: back into recorded time, or forward into simulated time to come. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import type { ClockState } from "../../protocol/generated/page_messages";
import { Button } from "../../theme/button";
import { fixed } from "../../theme/format";
import { NumberField } from "../../theme/number_field";
import type { Fields } from "../../protocol/connection";
import type { Shell } from "../shell";
import { Dialog } from "./dialog";

const NS = 1e9;
const MAX_STEPS = 1_000_000;
const MAX_TIME = 9e9;

export function TimeDialog({ shell }: { readonly shell: Shell }): JSX.Element {
  const { connection, session, world } = shell.page;
  const state = world.state.value;
  const steps = useSignal(100);
  const time = useSignal(Number(((state?.time_ns ?? 0) / NS).toFixed(3)));
  const fault = useSignal("");
  const close = (): void => void (shell.dialog.value = null);
  const ask = <N extends "step" | "seek" | "run_to">(name: N, fields: Fields<N>): Promise<void> =>
    connection
      .request(name, fields)
      .then(close, (error: unknown) => void (fault.value = error instanceof Error ? error.message : String(error)));
  return (
    <Dialog title="Steps and times" class="save" onClose={close}>
      <div class="form">
        <label class="row act">
          <span class="t2">Time</span>
          <NumberField
            label="Time"
            value={time.value}
            unit="s"
            min={0}
            max={MAX_TIME}
            onCommit={(value) => (time.value = value)}
          />
          <Button tone="line" disabled={state === null} onClick={() => void ask(...requestTo(time.value, state))}>
            Go
          </Button>
        </label>
        {session.kind === "simulation" && (
          <label class="row act">
            <span class="t2">Steps</span>
            <NumberField
              label="Steps"
              value={steps.value}
              integer
              min={1}
              max={MAX_STEPS}
              onCommit={(value) => (steps.value = value)}
            />
            <Button tone="line" onClick={() => void ask("step", { count: steps.value })}>
              Step
            </Button>
          </label>
        )}
        {state?.timeline !== undefined && (
          <p class="t2">
            {fixed(state.timeline.start_ns / NS, 2)} s to {fixed(state.timeline.end_ns / NS, 2)} s{" "}
            {session.kind === "simulation"
              ? "are recorded; a later time is simulated, and then the simulation pauses."
              : "were recorded."}
          </p>
        )}
      </div>
      <div class="foot">
        <span class="sm" role="alert">
          {fault.value}
        </span>
      </div>
    </Dialog>
  );
}

/** The request that goes to a time [s]. */
export function requestTo(
  seconds: number,
  state: ClockState | null,
): ["seek" | "run_to", { readonly time_ns: number }] {
  const time_ns = Math.round(seconds * NS);
  const end = state?.timeline?.end_ns ?? state?.time_ns ?? 0;
  return [state?.timeline !== undefined && time_ns <= end ? "seek" : "run_to", { time_ns }];
}
