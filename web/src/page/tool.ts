/** Interfaces of the page's tools, rviz's and our own. */

import type { ReadonlySignal } from "@preact/signals";
import type { Vector3 } from "three";

import type { Property, YamlMapping } from "../rviz/properties";
import type { PointerInput } from "../scene/pointer_input";
import type { Insertable } from "./insertable";

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
  /** Topic on which it publishes for navigation; null: none. */
  readonly navigates: ReadonlySignal<string | null>;
  /** Next action of the person, shown as a hint. */
  readonly hint: ReadonlySignal<string>;
  activate(): void;
  deactivate(): void;
  /** True: the event is the tool's; false: the camera's. */
  pointer(input: PointerInput): boolean;
}

/** Puts a model, a shape or a light into the world. */
export interface Inserter extends Tool {
  /** Item being inserted; null: none. */
  readonly chosen: ReadonlySignal<Insertable | null>;
  /** Inserts something at a point of the world [m]. */
  onPlace: (item: Insertable, point: Vector3) => void;
  /** Choose the item that follows the pointer; null: none. */
  choose(item: Insertable | null): void;
  /** Show the item at the point of the world under a point of the view [px]. */
  hover(x: number, y: number): void;
  hide(): void;
  /** Insert the item at the point of the world under a point of the view [px]. */
  place(x: number, y: number): void;
  placeInMiddle(): void;
}

export interface ToolBox {
  readonly tools: readonly Tool[];
  readonly current: ReadonlySignal<Tool>;
  /** Null where no world can be changed. */
  readonly insert: Inserter | null;
  use(className: string): void;
  /** The `Tools` list of an .rviz file. */
  save(): readonly YamlMapping[];
  load(yaml: readonly YamlMapping[]): string[];
}
