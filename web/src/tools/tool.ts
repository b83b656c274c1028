/** Interface of rviz's tools. */

import type { ReadonlySignal } from "@preact/signals";

import type { Property, YamlMapping } from "../rviz/properties";
import type { PointerInput } from "../scene/pointer_input";
import type { InsertTool } from "./insert_tool";

export interface Tool {
  /** rviz's class: `rviz/SetGoal`. */
  readonly className: string;
  /** rviz's name: `2D Nav Goal`. */
  readonly name: string;
  /** rviz's key; one letter. */
  readonly shortcut: string;
  readonly icon: string;
  readonly properties: readonly Property<unknown>[];
  readonly cursor: string;
  /** True: it publishes. */
  readonly acts: boolean;
  /** What a person does next, for the hint. */
  readonly hint: ReadonlySignal<string>;
  activate(): void;
  deactivate(): void;
  /** True: the event is the tool's; false: the camera's. */
  pointer(input: PointerInput): boolean;
}

export interface ToolBox {
  readonly tools: readonly Tool[];
  readonly current: ReadonlySignal<Tool>;
  /** Null where no world can be changed. */
  readonly insert: InsertTool | null;
  use(className: string): void;
  /** The `Tools` list of an .rviz file. */
  save(): readonly YamlMapping[];
  load(yaml: readonly YamlMapping[]): string[];
}
