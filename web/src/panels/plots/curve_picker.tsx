/** Picker of a number to plot: by its path, or from a tree of the messages' fields. */

import type { JSX } from "preact";
import { useSignal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";

import type { Page } from "../../page/page";
import type { RosMessage } from "../../protocol/ros_types";
import { Button } from "../../theme/button";
import { Combo } from "../../theme/combo";
import { Tree, type TreeRow } from "../../theme/tree";
import { messageRows } from "../messages/message_rows";
import { numberAt, parseSteps, stepsText, type Step } from "../messages/field_path";
import { numericPaths } from "../messages/numeric_paths";
import { MessageType } from "../messages/definition";
import { FilterField } from "../parts";
import type { PlotsState } from "./plots_state";
import { valueOwners } from "./simulated_values";

const MAX_RESULTS = 200;
const WAITS = " waits";
const PERIOD = 500; // ms between drawings of the tree

export function CurvePicker({ page, state }: { readonly page: Page; readonly state: PlotsState }): JSX.Element {
  const paths = usePaths(page);
  const [open, setOpen] = useState<ReadonlySet<string>>(new Set());
  const messages = useMessages(page, open);
  const search = useSignal("");
  const query = search.value.trim().toLowerCase();
  const rows = [
    ...simulatedRows(page, open, query),
    ...topicRows(page, open, messages).filter(
      ({ label }) => query === "" || (label ?? "").toLowerCase().includes(query),
    ),
  ];
  const plotted = new Map(state.curves.map((curve) => [curve.path, curve]));
  const toggle = (key: string, on: boolean): void => {
    const next = new Set(open);
    if (on) next.add(key);
    else next.delete(key);
    setOpen(next);
  };
  /** Toggle the plot of a number, or a heading. */
  const pick = (key: string): void => {
    const isOpen = rows.find((one) => one.key === key)?.open;
    const curve = plotted.get(key);
    if (isOpen !== undefined) toggle(key, !isOpen);
    else if (curve !== undefined) state.remove(curve);
    else if (!key.endsWith(WAITS)) state.add(key);
  };
  return (
    <>
      <div class="toolrow">
        <span class="sm t2">Path</span>
        <Combo
          label="Path of a curve"
          value=""
          choices={() => paths.map((value) => ({ value }))}
          onCommit={(path) => state.add(path)}
        />
        <Button small icon="close" label="Close" onClick={() => void (state.isAdding.value = false)} />
      </div>
      <FilterField label="Search values" value={search} />
      <div class="scroll">
        <Tree
          label="Numbers that can be plotted"
          rows={rows.map((one) => ({ ...one, selected: plotted.has(one.key) }))}
          onToggle={toggle}
          onSelect={pick}
        />
      </div>
    </>
  );
}

/** Paths of all numbers that definitions alone tell, without a message. */
function usePaths(page: Page): readonly string[] {
  const [paths, setPaths] = useState<readonly string[]>([]);
  const { topics } = page.connection;
  const known = topics.value;
  useEffect(() => {
    let isOver = false;
    const simulated = valueOwners(page.world.manifest.peek(), page.session.kind).flatMap(({ values }) => values);
    const all = [...known.values()].map(async ({ name, type }) => {
      const text = await page.connection.definition(type).catch(() => "");
      return numericPaths(MessageType.parse(text)).map((path) => name + path);
    });
    void Promise.all(all).then((query) => {
      if (!isOver) setPaths([...simulated, ...query.flat().sort()]);
    });
    return () => {
      isOver = true;
    };
  }, [page, known]);
  return paths;
}

/** Newest messages of the topics that are open. */
function useMessages(
  page: Page,
  open: ReadonlySet<string>,
): ReadonlyMap<string, { readonly type: string; readonly message: RosMessage }> {
  const [messages, setMessages] = useState<
    ReadonlyMap<string, { readonly type: string; readonly message: RosMessage }>
  >(new Map());
  useEffect(() => {
    const newest = new Map<string, { readonly type: string; readonly message: RosMessage }>();
    const subscriptions = [...open]
      .filter((key) => page.connection.topics.peek().has(key))
      .map((topic) => page.connection.subscribe(topic, ({ type, message }) => newest.set(topic, { type, message })));
    const timer = setInterval(() => setMessages(new Map(newest)), PERIOD);
    return () => {
      clearInterval(timer);
      for (const subscription of subscriptions) subscription.close();
    };
  }, [page, open]);
  return messages;
}

/** Models, links, joints and sensors with their values; matches of a search are open. */
function simulatedRows(page: Page, open: ReadonlySet<string>, search: string): readonly TreeRow[] {
  const rows = valueOwners(page.world.manifest.value, page.session.kind).flatMap(({ name, kind, values }) => {
    const depth = kind === "model" ? 0 : kind === "sensor" ? 2 : 1;
    const label = kind === "model" ? name : name.slice(name.lastIndexOf("::") + 2);
    if (search !== "") {
      const hits = values.filter((value) => value.toLowerCase().includes(search));
      return hits.map((value) => row(value, 0, value, kind, undefined));
    }
    const model = name.split("::")[0] ?? name;
    if (kind !== "model" && !open.has(model)) return [];
    const isOpen = open.has(name);
    return [
      row(name, depth, label, kind, isOpen),
      ...(isOpen ? values.map((value) => row(value, depth + 1, value.slice(name.length + 1), "", undefined)) : []),
    ];
  });
  return rows.slice(0, search === "" ? rows.length : MAX_RESULTS);
}

function topicRows(
  page: Page,
  open: ReadonlySet<string>,
  messages: ReturnType<typeof useMessages>,
): readonly TreeRow[] {
  const topics = [...page.connection.topics.value.values()].sort((one, other) => (one.name < other.name ? -1 : 1));
  return topics.flatMap(({ name, type }) => {
    const isOpen = open.has(name);
    const rows = [row(name, 0, name, type, isOpen)];
    if (!isOpen) return rows;
    const newest = messages.get(name);
    if (newest === undefined) return [...rows, row(name + WAITS, 1, "No message yet", "", undefined)];
    const fields = messageRows(newest.type, newest.message, (key) => open.has(name + key)).map((field) => {
      const steps = parseSteps(field.key);
      const isNumber = steps !== null && numberAt(newest.message, steps) !== null;
      const key = name + (steps !== null && isNumber ? stepsText(named(newest.message, steps)) : field.key);
      return row(key, field.depth + 1, field.name, field.text, field.open);
    });
    return [...rows, ...fields];
  });
}

/** A path's steps, with an element's name in place of its index where the message names its elements. */
function named(message: RosMessage, steps: readonly Step[]): readonly Step[] {
  return steps.map((step, at) => {
    if (typeof step === "string" || !("index" in step)) return step;
    const names = [...steps.slice(0, Math.max(0, at - 1)), "name"];
    const name = numberAt(message, names) === null ? nameAt(message, names, step.index) : null;
    return name === null ? step : { name };
  });
}

function nameAt(message: RosMessage, names: readonly Step[], index: number): string | null {
  let value: unknown = message;
  for (const step of names) value = typeof step === "string" ? (value as RosMessage)[step] : undefined;
  const name: unknown = Array.isArray(value) ? value[index] : null;
  return typeof name === "string" ? name : null;
}

function row(key: string, depth: number, name: string, detail: string, open: boolean | undefined): TreeRow {
  return {
    key,
    depth,
    label: `${name} ${detail}`.trim(),
    open,
    content: (
      <>
        <span class="n">{name}</span>
        <span class="r">{detail}</span>
      </>
    ),
  };
}
