/** Fields of the picked object, nested as in its message. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import { plain } from "../../theme/format";
import { Tree, type TreeRow } from "../../theme/tree";

/** Entries of a list or message that are shown at once. */
const SHOWN = 100;

export function PickedSection({ fields }: { readonly fields: Readonly<Record<string, unknown>> }): JSX.Element {
  const toggled = useSignal<ReadonlyMap<string, boolean>>(new Map());
  const isOpen = (key: string): boolean => toggled.value.get(key) ?? !key.includes("/");
  return (
    <section class="sec flush">
      <Tree
        label="Fields"
        rows={fieldRows(fields, "", 0, isOpen)}
        onToggle={(key, open) => (toggled.value = new Map(toggled.value).set(key, open))}
        onSelect={() => undefined}
      />
    </section>
  );
}

function fieldRows(fields: object, parent: string, depth: number, isOpen: (key: string) => boolean): TreeRow[] {
  return Object.entries(fields)
    .slice(0, SHOWN)
    .flatMap(([name, value]: [string, unknown]) => {
      const key = parent === "" ? name : `${parent}/${name}`;
      const nested = typeof value === "object" && value !== null ? value : null;
      const open = nested === null ? undefined : isOpen(key);
      const content = (
        <>
          <span class="n g">{name}</span>
          <span class="r">
            {nested === null ? fieldText(value) : Array.isArray(nested) ? `${nested.length} entries` : ""}
          </span>
        </>
      );
      const row: TreeRow = { key, depth, open, content };
      return [row, ...(nested !== null && open === true ? fieldRows(nested, key, depth + 1, isOpen) : [])];
    });
}

function fieldText(value: unknown): string {
  if (typeof value === "number") return plain(value);
  return typeof value === "string" ? value : String(value);
}
