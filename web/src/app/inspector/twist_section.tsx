/** Section with the twist of a body, whose numbers can be edited if the twist can be set. */

import type { JSX } from "preact";
import { useEffect, useMemo } from "preact/hooks";

import { fixed } from "../../theme/format";
import { NumberField } from "../../theme/number_field";
import type { Page } from "../../page/page";
import { useSampled } from "../sampled";
import { MotionSamples, type Twist } from "./twist";
import { withNumber } from "../../page/request_fields";

const STILL: Twist = { linear: [0, 0, 0], angular: [0, 0, 0] };

interface TwistProps {
  readonly page: Page;
  readonly body: number;
  /** Sets it once; absent: read-only. */
  readonly onCommit?: ((after: Twist, before: Twist) => void) | undefined;
}

export function TwistSection({ page, body, onCommit }: TwistProps): JSX.Element {
  const samples = useMemo(() => new MotionSamples(), [page, body]);
  useEffect(
    () =>
      page.world.onPoses((time) => {
        const pose = page.world.pose(body);
        if (pose !== null) samples.add({ time, ...pose });
      }),
    [page, body, samples],
  );
  const measured = useSampled(() => samples.twist());
  const twist = page.world.state.value?.paused === true ? null : measured;
  const now = twist ?? STILL;
  const commit = (part: keyof Twist) =>
    onCommit === undefined
      ? null
      : (index: number, value: number): void => onCommit({ ...now, [part]: withNumber(now[part], index, value) }, now);
  return (
    <section class="sec">
      <h3>
        Twist <span class="dim">in world</span>
      </h3>
      <div class="twist3">
        {["", "x", "y", "z", ""].map((head, index) => (
          <span key={index} class="h">
            {head}
          </span>
        ))}
        <TwistRow name="linear" values={twist?.linear} unit="m/s" onCommit={commit("linear")} />
        <TwistRow name="angular" values={twist?.angular} unit="rad/s" onCommit={commit("angular")} />
      </div>
    </section>
  );
}

interface RowProps {
  readonly name: string;
  readonly values: Twist["linear"] | undefined;
  readonly unit: string;
  readonly onCommit: ((index: number, value: number) => void) | null;
}

function TwistRow({ name, values, unit, onCommit }: RowProps): JSX.Element {
  return (
    <>
      <span>{name}</span>
      {[0, 1, 2].map((index) => (
        <span key={index}>
          {onCommit === null ? (
            fixed(values?.[index], 2)
          ) : (
            <NumberField
              label={`${name} ${"xyz"[index] ?? ""} [${unit}]`}
              value={values?.[index] ?? 0}
              decimals={2}
              min={-1e6}
              max={1e6}
              class="small bare num"
              onCommit={(value) => onCommit(index, value)}
            />
          )}
        </span>
      ))}
      <span>{unit}</span>
    </>
  );
}
