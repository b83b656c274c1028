/** The Tool properties page: rviz's tools that have properties. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import { Tree } from "../theme/tree";
import { propertyRows } from "./displays/property_rows";
import type { Shell } from "./shell";

export function ToolsPage({ shell }: { readonly shell: Shell }): JSX.Element {
  const { page } = shell;
  const toggled = useSignal<ReadonlyMap<string, boolean>>(new Map());
  const onToggle = (key: string, open: boolean): void => {
    toggled.value = new Map(toggled.value).set(key, open);
  };
  const isOpen = (key: string): boolean => toggled.value.get(key) ?? !key.includes("/");
  const tools = page.tools.tools.filter((tool) => tool.properties.length > 0);
  if (tools.length === 0) return <p class="empty">No tool here has properties.</p>;
  const rows = tools.flatMap((tool) => {
    const open = isOpen(tool.name);
    const content = <span class="n">{tool.name}</span>;
    const heading = { key: tool.name, depth: 0, open, content };
    return [heading, ...(open ? propertyRows(tool.properties, `${tool.name}/`, 1, { page, isOpen, onToggle }) : [])];
  });
  return (
    <div class="scroll">
      <Tree label="Tool properties" rows={rows} onToggle={onToggle} onSelect={() => undefined} />
    </div>
  );
}
