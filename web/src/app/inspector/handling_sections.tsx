/** Sections that hold a model in the air, copy or delete it, or push it by a force for a time. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";

import type { ApplyWrench, ModelInfo } from "../../protocol/generated/page_messages";
import type { Triple } from "../../scene/simulated_world";
import { Button } from "../../theme/button";
import { copyModel, deleteModel, holdModel } from "../world/model_edits";
import type { Shell } from "../shell";
import { NumbersRow } from "./value_rows";
import { withNumber } from "../../page/request_fields";

const LIMITS = { min: -1e6, max: 1e6 };
const AXES = ["x", "y", "z"] as const;
const ZERO: Triple = [0, 0, 0];

/** Buttons of actions on a whole model. */
export function ModelButtons({
  shell,
  name,
  model,
}: {
  readonly shell: Shell;
  readonly name: string;
  readonly model: ModelInfo;
}): JSX.Element {
  return (
    <div class="sides two">
      {!model.static && (
        <Button small tone="line" on={model.held} onClick={() => holdModel(shell, name, !model.held)}>
          Hold in the air
        </Button>
      )}
      <Button small tone="line" onClick={() => void shell.editor.begin(name)}>
        Edit model…
      </Button>
      <Button small tone="line" onClick={() => copyModel(shell, name)}>
        Copy
      </Button>
      <Button small tone="line" onClick={() => deleteModel(shell, name)}>
        Delete
      </Button>
    </div>
  );
}

/** Pushes a link at its centre of mass with the typed force and torque; Enter in a field applies them. */
export function WrenchSection({
  shell,
  model,
  link,
}: {
  readonly shell: Shell;
  readonly model: string;
  readonly link: string;
}): JSX.Element {
  const force = useSignal<Triple>(ZERO);
  const torque = useSignal<Triple>(ZERO);
  const duration = useSignal(1);
  const section = useRef<HTMLElement>(null);
  const target = shell.wrench.value;
  useEffect(() => {
    if (target?.model !== model || target.link !== link) return;
    section.current?.querySelector("input")?.focus();
    shell.wrench.value = null;
  }, [target, model, link]);
  const push = (by: Pick<ApplyWrench, "force" | "torque">, seconds: number): void =>
    shell.request(`Force on ${link}`, "wrench", { model, link, ...by, duration: seconds });
  const apply = (): void => push({ force: force.value, torque: torque.value }, duration.value);
  const labels = (name: string): readonly string[] => AXES.map((axis) => `${name} ${axis}`);
  return (
    <section class="sec" ref={section}>
      <h3>
        Force and torque <span class="dim">in world</span>
      </h3>
      <NumbersRow
        name="Force"
        labels={labels("force")}
        values={force.value}
        unit="N"
        {...LIMITS}
        onCommit={(i, value) => (force.value = withNumber(force.value, i, value))}
        onEnter={apply}
      />
      <NumbersRow
        name="Torque"
        labels={labels("torque")}
        values={torque.value}
        unit="N m"
        {...LIMITS}
        onCommit={(i, value) => (torque.value = withNumber(torque.value, i, value))}
        onEnter={apply}
      />
      <NumbersRow
        name="For"
        labels={["duration"]}
        values={[duration.value]}
        unit="s"
        min={1e-3}
        max={1e6}
        onCommit={(_, value) => (duration.value = value)}
        onEnter={apply}
      />
      <div class="sides">
        <Button small tone="line" onClick={apply}>
          Apply
        </Button>
        <Button small tone="line" onClick={() => push({ force: ZERO, torque: ZERO }, 1e-3)}>
          Stop
        </Button>
      </div>
    </section>
  );
}
