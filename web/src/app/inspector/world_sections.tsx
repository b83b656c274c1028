/** Sections of the world itself and of a light. */

import type { JSX } from "preact";

import type { LightInfo, Manifest } from "../../protocol/generated/page_messages";
import { Button } from "../../theme/button";
import { plain } from "../../theme/format";
import { deleteLight } from "../world/model_edits";
import type { Shell } from "../shell";
import { KeyValue, NumbersRow } from "./value_rows";
import type { Fields } from "../../protocol/connection";
import { canEdit, editWorld } from "../world/edits";
import { withNumber } from "../../page/request_fields";

const MILLI = 1e-3;
const AXES = ["x", "y", "z"] as const;

export function WorldSections({
  shell,
  manifest,
}: {
  readonly shell: Shell;
  readonly manifest: Manifest;
}): JSX.Element {
  const { gravity, wind, step } = manifest.physics;
  if (!canEdit(shell)) {
    return (
      <section class="sec">
        <h3>Physics</h3>
        <KeyValue name="Gravity" value={gravity.map(plain).join(" · ")} unit="m/s²" />
        <KeyValue name="Wind" value={wind.map(plain).join(" · ")} unit="m/s" />
        <KeyValue name="Time step" value={plain(step / MILLI)} unit="ms" />
      </section>
    );
  }
  const set = (title: string, after: Fields<"physics">, before: Fields<"physics">): void =>
    void editWorld(shell, title, "physics", after, before);
  const labels = (name: string): readonly string[] => AXES.map((axis) => `${name} ${axis}`);
  const limits = { min: -1e6, max: 1e6 };
  return (
    <section class="sec">
      <h3>Physics</h3>
      <NumbersRow
        name="Gravity"
        labels={labels("gravity")}
        values={gravity}
        unit="m/s²"
        {...limits}
        onCommit={(i, value) => set("Gravity", { gravity: withNumber(gravity, i, value) }, { gravity })}
      />
      <NumbersRow
        name="Wind"
        labels={labels("wind")}
        values={wind}
        unit="m/s"
        {...limits}
        onCommit={(i, value) => set("Wind", { wind: withNumber(wind, i, value) }, { wind })}
      />
      <NumbersRow
        name="Time step"
        labels={["time step"]}
        values={[Number((step / MILLI).toPrecision(9))]}
        unit="ms"
        min={1e-3}
        max={1e3}
        onCommit={(_, value) => set("Time step", { step: value * MILLI }, { step })}
      />
    </section>
  );
}

export function LightSections({ shell, light }: { readonly shell: Shell; readonly light: LightInfo }): JSX.Element {
  const { name, diffuse, intensity } = light;
  const fields = (changes: Partial<Pick<LightInfo, "diffuse" | "intensity">>): Fields<"light"> => ({
    light: name,
    diffuse,
    intensity,
    ...changes,
  });
  const set = (changes: Partial<Pick<LightInfo, "diffuse" | "intensity">>): void =>
    void editWorld(shell, `Light ${name}`, "light", fields(changes), fields({}));
  return (
    <section class="sec">
      <h3>Light</h3>
      <KeyValue name="Type" value={light.type} />
      {canEdit(shell) ? (
        <>
          <NumbersRow
            name="Red · green · blue"
            labels={["red", "green", "blue"]}
            values={diffuse}
            min={0}
            max={1}
            onCommit={(i, value) => set({ diffuse: withNumber(diffuse, i, value) })}
          />
          <NumbersRow
            name="Intensity"
            labels={["intensity"]}
            values={[intensity]}
            min={0}
            max={1e6}
            onCommit={(_, value) => set({ intensity: value })}
          />
          {light.body === null && (
            <div class="sides">
              <Button small tone="line" onClick={() => deleteLight(shell, name)}>
                Delete
              </Button>
            </div>
          )}
        </>
      ) : (
        <KeyValue name="Intensity" value={plain(intensity)} />
      )}
    </section>
  );
}
