/** Drive: the disc, the commanded velocities, their limits, and the topic. */

import type { JSX } from "preact";
import { useEffect } from "preact/hooks";

import { fixed } from "../../theme/format";
import { NumberField } from "../../theme/number_field";
import { Select } from "../../theme/select";
import type { Drive } from "../../page/drive";
import { DriveDisc } from "./disc";
import { listenToDriveKeys, WASD } from "./keys";
import type { Shell } from "../shell";

export function DriveView({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const { page, layout } = shell;
  const { drive, session } = page;
  const pads = !session.joystick;
  useEffect(() => listenToDriveKeys(drive, { pads }), [drive, pads]); // by fields, since a new session must not release held keys
  const topic = drive.topic.value;
  if (topic === null) return null;
  const command = drive.command.value;
  if (layout.isPhone.value) {
    return (
      <div class="drive">
        <Reading class="pv l float" value={command?.linear ?? 0} unit="v, m/s" />
        <DriveDisc drive={drive} />
        <Reading class="pv r float" value={command?.angular ?? 0} unit="w, rad/s" />
      </div>
    );
  }
  return (
    <div class="drive float">
      <DriveDisc drive={drive} />
      <div class="driven">
        <Limit name="v" full="Largest speed" value={command?.linear ?? 0} limit={drive.linearLimit} unit="m/s" />
        <Limit
          name="w"
          full="Largest turning speed"
          value={command?.angular ?? 0}
          limit={drive.angularLimit}
          unit="rad/s"
        />
        <Keys drive={drive} />
        {command === null ? <Topic drive={drive} topic={topic} /> : <span class="cap">{heldText(drive)}</span>}
      </div>
    </div>
  );
}

function heldText(drive: Drive): string {
  const delay = drive.delay.value;
  return delay > 0 ? `Commands ${fixed(delay, 1)} s late` : "Let go to stop";
}

function Topic({ drive, topic }: { readonly drive: Drive; readonly topic: string }): JSX.Element {
  const topics = drive.topics.value;
  if (topics.length < 2) return <span class="cap">{topic}</span>;
  return (
    <span class="cap">
      <Select label="Driven topic" value={topic} choices={topics} onChange={(name) => drive.choose(name)} />
    </span>
  );
}

interface LimitProps {
  readonly name: string;
  readonly full: string;
  readonly value: number;
  readonly limit: Drive["linearLimit"];
  readonly unit: string;
}

function Limit({ name, full, value, limit, unit }: LimitProps): JSX.Element {
  return (
    <div class="limit">
      <span class="t2">{name}</span>
      <output>{fixed(value, 2)}</output>
      <span class="of">of</span>
      <NumberField
        label={full}
        value={limit.value}
        decimals={2}
        min={0.01}
        max={20}
        class="small bare"
        onCommit={(to) => (limit.value = to)}
      />
      <span class="of">{unit}</span>
    </div>
  );
}

function Keys({ drive }: { readonly drive: Drive }): JSX.Element {
  const command = drive.command.value;
  const isDown = (key: string): boolean => {
    const input = WASD[key];
    return (
      command !== null &&
      input !== undefined &&
      (input.linear * command.linear > 0 || input.angular * command.angular > 0)
    );
  };
  return (
    <div class="keys" aria-hidden="true">
      {["w", "a", "s", "d"].map((key) => (
        <kbd key={key} class={isDown(key) ? "dn" : ""}>
          {key.toUpperCase()}
        </kbd>
      ))}
    </div>
  );
}

function Reading({
  class: name,
  value,
  unit,
}: {
  readonly class: string;
  readonly value: number;
  readonly unit: string;
}): JSX.Element {
  return (
    <span class={name}>
      <b>{fixed(value, 2)}</b>
      <span class="xs dim">{unit}</span>
    </span>
  );
}
