/** The World page: search, and the tree of the simulated world. */

import { untracked, useComputed, useSignal, useSignalEffect, type ReadonlySignal, type Signal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";

import type { Manifest } from "../../protocol/generated/page_messages";
import { DraftTree } from "../editor/draft_tree";
import { Icon } from "../../theme/icons";
import { Name } from "../../theme/name";
import { SteadyNumber } from "../../theme/steady_number";
import { Tree, type TreeRow } from "../../theme/tree";
import { frameSelection } from "../views/framing";
import { jointValue } from "../inspector/joint_values";
import { openMenu } from "../object_menu/object_menu";
import type { Shell } from "../shell";
import { toggleHidden } from "../views/shown_parts";
import { canEdit } from "./edits";
import { WorldMenu } from "./menu";
import {
  allModels,
  bodiesOf,
  keyOf,
  pathTo,
  visibleNodes,
  worldNode,
  type VisibleNode,
  type WorldNode,
} from "../../page/world_nodes";

export function WorldTree({ shell }: { readonly shell: Shell }): JSX.Element {
  const { world, selection, session } = shell.page;
  const root = useComputed(() =>
    world.manifest.value === null ? null : worldNode(world.manifest.value, shell.page.session.title),
  );
  const search = useSignal("");
  const rows = useRef(new WorldRows());
  const { isOpen, setOpen } = useOpenRows(shell, root, search);
  if (root.value === null) {
    const message =
      session.kind === "graph" ? "Nothing is simulated here: this page shows a ROS graph." : "Loading the world.";
    return <p class="empty">{message}</p>;
  }
  const draft = shell.editor.draft.value;
  if (draft !== null) return <DraftTree shell={shell} draft={draft} />;
  const nodes = visibleNodes(root.value, isOpen, search.value);
  const byKey = new Map(nodes.map((row) => [row.node.key, row.node]));
  const selected = keyOf(selection.value);
  return (
    <>
      <div class="search">
        <Search shell={shell} text={search} />
        {canEdit(shell) && <WorldMenu shell={shell} />}
      </div>
      <div class="scroll">
        {nodes.length === 0 && <p class="empty">No matching object.</p>}
        <Tree
          label="World"
          rows={nodes.map((row) => rows.current.of(shell, row, row.node.key === selected))}
          onToggle={setOpen}
          onSelect={(key) => {
            const node = byKey.get(key);
            if (node?.selection !== null && node?.selection !== undefined) selection.value = node.selection;
          }}
          onHover={(key) => (shell.page.hovered.value = (key === null ? null : byKey.get(key)?.selection) ?? null)}
          onActivate={(key) => {
            const chosen = byKey.get(key)?.selection ?? null;
            selection.value = chosen ?? selection.value;
            frameSelection(shell.page, chosen);
          }}
          onMenu={(key, x, y) => openMenu(shell, byKey.get(key)?.selection ?? null, x, y)}
          onKey={(key, event) => {
            const hides = byKey.get(key)?.hides ?? null;
            if (event.key !== " " || hides === null || !shell.isDrawn.value) return;
            event.preventDefault();
            toggleHidden(shell.page, hides);
          }}
        />
      </div>
    </>
  );
}

/** Open rows: those that the person has opened, and the ancestors of each new selection. */
function useOpenRows(
  { page: { world, selection } }: Shell,
  root: ReadonlySignal<WorldNode | null>,
  search: Signal<string>,
): { readonly isOpen: (node: WorldNode) => boolean; readonly setOpen: (key: string, open: boolean) => void } {
  const toggled = useSignal<ReadonlyMap<string, boolean>>(new Map());
  const opened = useComputed(() => openedAtFirst(world.manifest.value));
  const isOpen = (node: WorldNode): boolean =>
    toggled.value.get(node.key) ?? (node.selection?.kind !== "model" || opened.value.has(node.hides ?? ""));
  const isLoaded = useComputed(() => root.value !== null);
  useSignalEffect(() => {
    const key = keyOf(selection.value);
    if (!isLoaded.value) return;
    untracked(() => {
      const path = root.value === null ? [] : pathTo(root.value, key);
      if (path.length === 0) return;
      const next = new Map(toggled.value);
      for (const node of path.slice(0, -1)) if (!isOpen(node)) next.set(node.key, true);
      toggled.value = next;
      if (root.value !== null && !visibleNodes(root.value, isOpen, search.value).some(({ node }) => node.key === key))
        search.value = "";
    });
  });
  return { isOpen, setOpen: (key, open) => (toggled.value = new Map(toggled.value).set(key, open)) };
}

/** Names of the models that are open at first: the robot, or without a robot, the only model that can move. */
function openedAtFirst(manifest: Manifest | null): ReadonlySet<string> {
  const models = allModels(manifest?.models ?? []);
  const robot = manifest?.robot ?? null;
  const shown =
    robot === null
      ? models.filter(({ model }) => !model.static)
      : models.filter(({ model }) => bodiesOf(model).includes(robot));
  return new Set(shown.length === 1 || robot !== null ? shown.map(({ name }) => name) : []);
}

/** Rows of the tree; an unchanged row stays the same object. */
class WorldRows {
  private readonly known = new WeakMap<WorldNode, { readonly shows: string; readonly row: TreeRow }>();

  of(shell: Shell, visibleNode: VisibleNode, selected: boolean): TreeRow {
    const { node, depth, isOpen } = visibleNode;
    const hidden = node.hides !== null && shell.page.world.hidden.value.has(node.hides);
    const shows = `${depth} ${isOpen} ${selected} ${hidden} ${shell.isDrawn.value}`;
    const known = this.known.get(node);
    if (known?.shows === shows) return known.row;
    const row = makeRow(shell, visibleNode, selected, hidden);
    this.known.set(node, { shows, row });
    return row;
  }
}

function makeRow(shell: Shell, { node, depth, isOpen }: VisibleNode, selected: boolean, hidden: boolean): TreeRow {
  return {
    key: node.key,
    depth,
    open: isOpen,
    selected,
    content: (
      <>
        {node.icon !== null && <Icon name={node.icon} />}
        <Name class={`${node.icon === null ? "n g" : "n"}${hidden ? " hid" : ""}`} text={node.label} />
        <span class="r">
          {typeof node.detail === "string" ? node.detail : <JointValue shell={shell} node={node} />}
        </span>
        {node.hides !== null && shell.isDrawn.value && <Eye shell={shell} name={node.hides} hidden={hidden} />}
      </>
    ),
  };
}

function JointValue({ shell, node }: { readonly shell: Shell; readonly node: WorldNode }): JSX.Element {
  const joint = typeof node.detail === "string" ? null : node.detail.joint;
  const state = joint?.index === null || joint === null ? undefined : shell.page.world.joints.value.at(joint.index);
  if (joint === null || state === undefined) return <>{joint?.type}</>;
  const { text, length, unit } = jointValue(joint, state);
  return (
    <>
      <SteadyNumber text={text} length={length} /> {unit}
    </>
  );
}

function Eye({
  shell,
  name,
  hidden,
}: {
  readonly shell: Shell;
  readonly name: string;
  readonly hidden: boolean;
}): JSX.Element {
  return (
    <button
      type="button"
      class={hidden ? "eye off" : "eye"}
      tabIndex={-1}
      aria-label={hidden ? `Show ${name}` : `Hide ${name}`}
      onClick={(event) => {
        event.stopPropagation();
        toggleHidden(shell.page, name);
      }}
    >
      <Icon name={hidden ? "eye_off" : "eye"} />
    </button>
  );
}

function Search({ shell, text }: { readonly shell: Shell; readonly text: Signal<string> }): JSX.Element {
  const input = useRef<HTMLInputElement>(null);
  useEffect(
    () =>
      shell.commands.add({
        id: "search_world",
        title: "Search the world",
        group: "View",
        keys: "/",
        run: () => input.current?.focus(),
      }),
    [shell],
  );
  return (
    <label class="field find">
      <Icon name="find" />
      <input
        ref={input}
        type="search"
        placeholder="Search the world"
        aria-label="Search the world"
        value={text.value}
        onInput={(event) => (text.value = event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key !== "Escape") return;
          text.value = "";
          event.currentTarget.blur();
        }}
      />
      <kbd>/</kbd>
    </label>
  );
}
