/** A form made from a definition: a row per field, arrays as YAML. */

import type { JSX } from "preact";
import { useState } from "preact/hooks";

import { Checkbox } from "../../theme/checkbox";
import { TextField } from "../../theme/text_field";
import type { FormRow, FormState } from "./form_state";

export function MessageForm({ label, form }: { readonly label: string; readonly form: FormState }): JSX.Element {
  const [closed, setClosed] = useState<ReadonlySet<string>>(new Set(["header"]));
  const toggle = (path: string): void => {
    const next = new Set(closed);
    if (!next.delete(path)) next.add(path);
    setClosed(next);
  };
  const isHidden = (path: string): boolean => [...closed].some((above) => path.startsWith(`${above}.`));
  return (
    <div class="form" role="group" aria-label={label}>
      {form.rows.length === 0 && <div class="empty">The message has no fields.</div>}
      {form.rows
        .filter((row) => !isHidden(row.path))
        .map((row) =>
          row.isHeading ? (
            <button
              key={row.path}
              type="button"
              class="formrow heading"
              style={{ "--d": row.depth }}
              aria-expanded={!closed.has(row.path)}
              onClick={() => toggle(row.path)}
            >
              {closed.has(row.path) ? "▸" : "▾"} {row.field.name} <span class="dim xs">{row.field.type}</span>
            </button>
          ) : (
            <Entry key={row.path} row={row} form={form} />
          ),
        )}
    </div>
  );
}

function Entry({ row, form }: { readonly row: FormRow; readonly form: FormState }): JSX.Element {
  const { field, path } = row;
  const text = form.text(row);
  const isSwitch = field.type === "bool" && !field.isArray;
  return (
    <div class="formrow" style={{ "--d": row.depth }}>
      <span class="label" title={path}>
        {field.name}
      </span>
      <span class="entry">
        {isSwitch ? (
          <Checkbox label={path} checked={text === "true"} onChange={(on) => form.set(path, String(on))} />
        ) : (
          <TextField
            label={path}
            value={text}
            class="small"
            check={(typed) => form.fault(row, typed)}
            onCommit={(typed) => form.set(path, typed)}
          />
        )}
      </span>
      <span class="dim xs">{typeText(row)}</span>
    </div>
  );
}

function typeText({ field }: FormRow): string {
  return field.isArray ? `${field.type}[${field.length ?? ""}]` : field.type;
}
