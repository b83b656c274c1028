/** Options of running nodes (rqt_reconfigure). */

import { signal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";

import { Controls } from "../page/view_only";
import { Checkbox } from "../theme/checkbox";
import { plain } from "../theme/format";
import { NumberField } from "../theme/number_field";
import { Select } from "../theme/select";
import { Slider } from "../theme/slider";
import { TextField } from "../theme/text_field";
import type { Panel, PanelProps } from "./panel";
import { perPage } from "./per_page";
import { hasSlider, type Option, type OptionValue } from "./reconfigure/reconfigure_config";
import { ReconfigureServer, serverNames } from "./reconfigure/reconfigure_server";

const reconfigureState = perPage(() => ({ selected: signal<string | null>(null) }));

function Reconfigure({ page }: PanelProps): JSX.Element {
  const { selected } = reconfigureState(page);
  const names = serverNames(page.connection.topics.value);
  const shown = names.find((name) => name === selected.value) ?? names[0];
  if (shown === undefined)
    return <div class="empty">No node has options: none publishes …/parameter_descriptions.</div>;
  return (
    <div class="split">
      <div class="servers" role="listbox" aria-label="Nodes with options">
        {names.map((name) => (
          <button
            key={name}
            type="button"
            role="option"
            aria-selected={name === shown}
            class={name === shown ? "row sel" : "row"}
            onClick={() => void (selected.value = name)}
          >
            <span class="n">{name}</span>
          </button>
        ))}
      </div>
      <Server key={shown} page={page} name={shown} />
    </div>
  );
}

function Server({ page, name }: PanelProps & { readonly name: string }): JSX.Element {
  const [server, setServer] = useState<ReconfigureServer | null>(null);
  useEffect(() => {
    const opened = new ReconfigureServer(page.connection, page.undo, name);
    setServer(opened);
    return () => opened.close();
  }, [page, name]);
  const groups = server?.groups.value;
  if (server === null || groups === null || groups === undefined) {
    const fault = server?.fault.value ?? "";
    return fault === "" ? (
      <div class="empty">Waiting for the description of {name}.</div>
    ) : (
      <div class="fault pad">{fault}</div>
    );
  }
  return (
    <div class="main">
      <div class="scroll">
        {server.fault.value !== "" && (
          <div class="fault pad" role="alert">
            {server.fault.value}
          </div>
        )}
        <Controls page={page}>
          {groups.map((group) => (
            <section key={group.id} aria-label={group.name}>
              {groups.length > 1 && <h2 class="headline">{group.name}</h2>}
              {group.options.map((option) => (
                <div key={option.name} class="formrow" title={option.description}>
                  <span class="label">{option.name}</span>
                  <Editor server={server} option={option} />
                </div>
              ))}
            </section>
          ))}
        </Controls>
      </div>
    </div>
  );
}

interface EditorProps {
  readonly server: ReconfigureServer;
  readonly option: Option;
}

function Editor({ server, option }: EditorProps): JSX.Element {
  const value = server.value(option);
  const change = (to: OptionValue): void => server.change(option, to);
  if (option.choices.length > 0) {
    const current = option.choices.find((choice) => choice.value === value);
    return (
      <span class="entry">
        <Select
          label={option.name}
          value={current?.name ?? String(value)}
          choices={option.choices.map((choice) => choice.name)}
          onChange={(name) => {
            const choice = option.choices.find((one) => one.name === name);
            if (choice !== undefined) change(choice.value);
          }}
        />
      </span>
    );
  }
  if (option.type === "bool") return <Checkbox label={option.name} checked={value === true} onChange={change} />;
  if (option.type === "str") {
    return (
      <span class="entry">
        <TextField label={option.name} class="small" value={String(value ?? "")} onCommit={change} />
      </span>
    );
  }
  return <NumberEditor server={server} option={option} value={Number(value ?? 0)} />;
}

/** Field, with a slider if the limits are narrow enough; a drag is a single undo step. */
function NumberEditor({ server, option, value }: EditorProps & { readonly value: number }): JSX.Element {
  const [before, setBefore] = useState<number | null>(null);
  const { lower, upper } = option;
  const isWhole = option.type === "int";
  return (
    <>
      {hasSlider(option) && lower !== null && upper !== null && (
        <span class="entry">
          <Slider
            label={`${option.name}, slider`}
            value={value}
            lower={lower}
            upper={upper}
            text={plain(value)}
            onInput={(at) => {
              setBefore(before ?? value);
              server.set(option, isWhole ? Math.round(at) : at);
            }}
            onRelease={() => {
              if (before === null) return;
              setBefore(null);
              server.commit(option, before, value);
            }}
          />
        </span>
      )}
      <span class="narrow">
        <NumberField
          label={option.name}
          class="small num"
          value={value}
          integer={isWhole}
          min={lower ?? undefined}
          max={upper ?? undefined}
          onCommit={(to) => server.change(option, to)}
        />
      </span>
    </>
  );
}

export const reconfigurePanel: Panel = {
  id: "reconfigure",
  title: "Reconfigure",
  programs: ["rqt_reconfigure", "reconfigure_gui"],
  component: Reconfigure,
};
