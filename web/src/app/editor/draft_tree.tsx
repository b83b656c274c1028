/** Tree of the edited model, in place of the world's tree, with the drawer of new parts below it. */

import { useSignal, useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";

import type { DraftInfo, DraftPart } from "../../protocol/generated/page_messages";
import type { Selection } from "../../page/page";
import type { Shell } from "../shell";
import { canEdit } from "../world/edits";
import { Button } from "../../theme/button";
import { count, fixed } from "../../theme/format";
import { Icon } from "../../theme/icons";
import { Name } from "../../theme/name";
import { StatusShape } from "../../theme/status_shape";
import { Tree, type TreeRow } from "../../theme/tree";
import type { PartPath } from "../../scene/draft";
import { iconOf } from "./part_icons";
import { PartDrawer } from "./part_drawer";

interface TreeProps {
  readonly shell: Shell;
  readonly draft: DraftInfo;
}

export function DraftTree({ shell, draft }: TreeProps): JSX.Element {
  const { editor, page } = shell;
  const edits = canEdit(shell);
  const toggled = useSignal<ReadonlyMap<string, boolean>>(new Map());
  const isAdding = useSignal(draft.parts.length === 1);
  useSignalEffect(() => {
    const selection = page.selection.value;
    if (selection?.kind === "part") toggled.value = withOpenAncestors(toggled.peek(), selection.part);
  });
  const selected = page.selection.value?.kind === "part" ? keyOf(page.selection.value.part) : null;
  const byKey = new Map(draft.parts.map((part) => [keyOf(part.part), part]));
  const select = (key: string): void => {
    const part = byKey.get(key);
    if (part !== undefined) page.selection.value = selectionOf(part);
  };
  return (
    <>
      <div class="editing">
        <Icon name="edit" />
        <span class="n">
          Editing <b>{draft.name}</b>
        </span>
        {edits && <Button icon="close" label="Leave the editor" small onClick={() => editor.leave()} />}
      </div>
      <div class="scroll">
        <Tree
          label="Model"
          rows={rows(draft, toggled.value, selected)}
          onToggle={(key, open) => (toggled.value = new Map(toggled.value).set(key, open))}
          onSelect={select}
          onHover={(key) => {
            const part = key === null ? undefined : byKey.get(key);
            page.hovered.value = part === undefined ? null : selectionOf(part);
          }}
        />
      </div>
      {edits && isAdding.value && <PartDrawer shell={shell} draft={draft} onClose={() => (isAdding.value = false)} />}
      <Verdict draft={draft} />
      {edits && (
        <div class="foot">
          <Button
            icon="plus"
            class="add"
            tone="line"
            on={isAdding.value}
            onClick={() => (isAdding.value = !isAdding.value)}
          >
            Add
          </Button>
          <span class="sp" />
          <Button onClick={() => (shell.dialog.value = "save_model")}>Save…</Button>
          <Button tone="primary" onClick={() => void editor.finish()}>
            Finish
          </Button>
        </div>
      )}
    </>
  );
}

/** Numbers of findings, errors first. */
function Verdict({ draft }: { readonly draft: DraftInfo }): JSX.Element {
  const findings = draft.parts.flatMap((part) => part.findings);
  const errors = findings.filter(({ severity }) => severity === "error").length;
  const warnings = findings.length - errors;
  const counts = [errors > 0 ? count(errors, "error") : "", warnings > 0 ? count(warnings, "warning") : ""].filter(
    (text) => text !== "",
  );
  return (
    <p class="verdict sm t2" role="status" aria-label="Check">
      <StatusShape level={errors > 0 ? "error" : warnings > 0 ? "warn" : "ok"} label="" />
      {counts.length === 0 ? "No errors or warnings" : counts.join(", ")}
    </p>
  );
}

function keyOf(path: PartPath): string {
  return JSON.stringify(path);
}

function selectionOf({ part }: DraftPart): Selection {
  return { kind: "part", part };
}

function rows(draft: DraftInfo, toggled: ReadonlyMap<string, boolean>, selected: string | null): readonly TreeRow[] {
  const isOpen = (part: PartPath): boolean => toggled.get(keyOf(part)) ?? part.length === 0; // at first only the model's row is open
  const shown = draft.parts.filter(({ part }) => ancestorsOf(part).every(isOpen));
  return shown.map((part) => {
    const key = keyOf(part.part);
    const hasMore = draft.parts.some(
      (finding) => finding.part.length > part.part.length && keyOf(finding.part.slice(0, part.part.length)) === key,
    );
    return {
      key,
      depth: part.part.length / 2,
      open: hasMore ? isOpen(part.part) : undefined,
      selected: key === selected,
      content: (
        <>
          <Icon name={iconOf(part)} />
          <Name text={part.name} />
          <span class="r">{part.mass === null ? part.detail : `${fixed(part.mass, part.mass < 0.1 ? 3 : 2)} kg`}</span>
          <Worst part={part} />
        </>
      ),
    };
  });
}

function ancestorsOf(part: PartPath): readonly PartPath[] {
  return Array.from({ length: part.length / 2 }, (_, depth) => part.slice(0, 2 * depth));
}

function withOpenAncestors(toggled: ReadonlyMap<string, boolean>, part: PartPath): ReadonlyMap<string, boolean> {
  return new Map([...toggled, ...ancestorsOf(part).map((ancestor) => [keyOf(ancestor), true] as const)]);
}

function Worst({ part }: { readonly part: DraftPart }): JSX.Element | null {
  const [first] = [...part.findings].sort((a, b) => a.severity.localeCompare(b.severity));
  return first === undefined ? null : (
    <StatusShape level={first.severity === "error" ? "error" : "warn"} label={first.text} />
  );
}
