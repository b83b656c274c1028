/** Section with a pose, whose numbers can be edited if the pose can be set. */

import type { JSX } from "preact";

import type { Transform } from "../../frames/transform";
import { fixed } from "../../theme/format";
import { NumberField } from "../../theme/number_field";
import { useSampled } from "../sampled";
import { rollPitchYaw } from "./twist";
import { orientationOf, withNumber } from "../../page/request_fields";

const DEGREE = Math.PI / 180;
const AXES = ["x", "y", "z"] as const;
const ANGLES = ["roll", "pitch", "yaw"] as const;

interface PoseProps {
  readonly within: string;
  readonly pose: () => Transform | null;
  /** Menu at the right of the heading. */
  readonly menu?: JSX.Element;
  /** Moves it to the pose; absent: read-only. */
  readonly onCommit?: ((after: Transform, before: Transform) => void) | undefined;
}

export function PoseSection({ within, pose, menu, onCommit }: PoseProps): JSX.Element {
  const now = useSampled(pose);
  const angles = now === null ? null : rollPitchYaw(now.orientation);
  const move = (index: number, value: number): void => {
    if (now === null) return;
    const position = now.position.clone().setComponent(index, value);
    onCommit?.({ position, orientation: now.orientation.clone() }, copied(now));
  };
  const turn = (index: number, degrees: number): void => {
    if (now === null) return;
    const orientation = orientationOf(withNumber(rollPitchYaw(now.orientation), index, degrees * DEGREE));
    onCommit?.({ position: now.position.clone(), orientation }, copied(now));
  };
  const set = now === null || onCommit === undefined ? null : { move, turn };
  return (
    <section class="sec" role="group" aria-label={`Pose in ${within}`}>
      <h3>
        Pose <span class="dim">in {within}</span>
        {menu !== undefined && <span class="sp" />}
        {menu}
      </h3>
      <div class="pose">
        {AXES.map((axis, index) => (
          <>
            <Reading
              key={axis}
              axis={axis}
              name={axis}
              value={now?.position[axis]}
              decimals={3}
              unit="m"
              onCommit={set === null ? null : (value) => set.move(index, value)}
            />
            <Reading
              key={`angle ${axis}`}
              axis={axis}
              name={ANGLES[index] ?? ""}
              value={angles === null ? undefined : (angles[index] ?? 0) / DEGREE}
              decimals={1}
              unit="°"
              onCommit={set === null ? null : (value) => set.turn(index, value)}
            />
          </>
        ))}
      </div>
    </section>
  );
}

function copied({ position, orientation }: Transform): Transform {
  return { position: position.clone(), orientation: orientation.clone() };
}

interface ReadingProps {
  readonly axis: "x" | "y" | "z";
  readonly name: string;
  readonly value: number | undefined;
  readonly decimals: number;
  readonly unit: string;
  readonly onCommit: ((value: number) => void) | null;
}

function Reading({ axis, name, value, decimals, unit, onCommit }: ReadingProps): JSX.Element {
  const head = (
    <span class="axis" style={{ "--ax": `var(--${axis})` }}>
      {name}
    </span>
  );
  if (onCommit !== null && value !== undefined) {
    return (
      <span class="cell">
        <NumberField
          label={name}
          value={value}
          decimals={decimals}
          unit={unit}
          min={-1e6}
          max={1e6}
          class="num"
          before={head}
          onCommit={onCommit}
        />
      </span>
    );
  }
  return (
    <div class="nf">
      {head}
      <output>{fixed(value ?? null, decimals)}</output>
      <span class="unit">{unit}</span>
    </div>
  );
}
