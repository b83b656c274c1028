/** Form of the selected part of the edited model: its findings, then its values. */

import type { JSX } from "preact";

import type { DraftFinding, DraftInfo, DraftPart } from "../../protocol/generated/page_messages";
import type { Shell } from "../shell";
import { canEdit } from "../world/edits";
import { Button } from "../../theme/button";
import { Icon } from "../../theme/icons";
import { StatusShape } from "../../theme/status_shape";
import { TextField } from "../../theme/text_field";
import { findPart, type PartPath } from "../../scene/draft";
import { FieldRow } from "./field_rows";
import { iconOf } from "./part_icons";

interface FormProps {
  readonly shell: Shell;
  readonly draft: DraftInfo;
  readonly path: PartPath;
}

export function PartForm({ shell, draft, path }: FormProps): JSX.Element {
  const part = findPart(draft, path);
  if (part === null) return <p class="empty">It is no longer in the model.</p>;
  return (
    <fieldset class="scroll inspector form" key={path.join("\n")} disabled={!canEdit(shell)}>
      <Title shell={shell} part={part} />
      {part.findings.length > 0 && <Findings findings={part.findings} />}
      {part.sections.map(({ title, fields }) => (
        <section class="sec" key={title} aria-label={title}>
          <h3>{title}</h3>
          {fields.map((field) => (
            <FieldRow key={field.name} field={field} onSet={(value) => shell.editor.set(path, field.name, value)} />
          ))}
          {part.tag === "plugin" && title === "Parameters" && <NewParameter shell={shell} path={path} />}
        </section>
      ))}
    </fieldset>
  );
}

function Title({ shell, part }: { readonly shell: Shell; readonly part: DraftPart }): JSX.Element {
  const { editor } = shell;
  return (
    <div class="ti">
      <h2>
        <Icon name={iconOf(part)} />
        <span class="n">{part.name}</span>
      </h2>
      {part.part.length > 0 && (
        <span class="acts">
          <Button icon="plus" label="Copy this part" keys="Shift C" small onClick={() => void editor.copy(part.part)} />
          <Button
            icon="close"
            label="Delete this part"
            keys="Delete"
            small
            onClick={() => void editor.remove(part.part)}
          />
        </span>
      )}
      <span class="sm t2">
        {part.part.length === 0 ? "model that is edited" : part.tag}
        {part.detail !== "" && ` · ${part.detail}`}
        {` · line ${part.line}`}
      </span>
    </div>
  );
}

function Findings({ findings }: { readonly findings: readonly DraftFinding[] }): JSX.Element {
  return (
    <ul class="findings" aria-label="Findings">
      {findings.map(({ severity, text, line }) => (
        <li key={`${line} ${text}`}>
          <StatusShape level={severity === "error" ? "error" : "warn"} />
          <span>
            {text}
            {line !== null && <span class="t3"> · line {line}</span>}
          </span>
        </li>
      ))}
    </ul>
  );
}

/** A parameter that the plugin's documentation does not name. */
function NewParameter({ shell, path }: { readonly shell: Shell; readonly path: PartPath }): JSX.Element {
  return (
    <div class="fr wide">
      <span class="k">Another</span>
      <span class="cells">
        <TextField
          label="Name of another parameter"
          value=""
          placeholder="name"
          class="small"
          check={(text) => (/^[A-Za-z_][\w.-]*$/.test(text) ? null : "A name of letters, digits and _, please.")}
          onCommit={(name) => shell.editor.set(path, name, "")}
        />
      </span>
    </div>
  );
}
