/** Base of rviz's tools. */

import { signal, type ReadonlySignal, type Signal } from "@preact/signals";

import type { GoalQueue } from "../page/goal_queue";
import type { Selection } from "../page/page";
import type { Property, Yaml, YamlMapping } from "../rviz/properties";
import type { Connection } from "../protocol/connection";
import type { GraphNames } from "../protocol/graph_names";
import { timeOf, type RosMessage } from "../protocol/ros_types";
import type { SceneView } from "../scene/scene_view";
import type { Views } from "../scene/view_controller";
import type { Tool } from "../page/tool";
import type { PointerInput } from "../scene/pointer_input";
import type { WorldEditor } from "../page/world_editor";

/** Parts of the page that tools use. */
export interface ToolContext {
  readonly connection: Pick<Connection, "publish" | "now">;
  readonly names: GraphNames;
  readonly scene: SceneView;
  readonly views: Pick<Views, "focus">;
  readonly fixedFrame: ReadonlySignal<string>;
  readonly selection: ReadonlySignal<Selection | null>;
  /** Select what was clicked in the scene. */
  readonly select: (selection: Selection | null) => void;
  readonly hovered: Signal<Selection | null>;
  readonly goals: GoalQueue;
  /** Null where no world can be changed. */
  readonly editor: WorldEditor | null;
  /** True on a view-only page: nothing in the scene can be pressed. */
  readonly viewOnly: boolean;
}

export abstract class BaseTool implements Tool {
  abstract readonly className: string;
  abstract readonly name: string;
  abstract readonly shortcut: string;
  abstract readonly icon: string;
  readonly cursor: string = "crosshair";
  readonly acts: boolean = false;
  readonly navigates: ReadonlySignal<string | null> = signal(null);
  readonly properties: Property<unknown>[] = [];
  readonly hint = signal("");
  /** Keys of the file that the page does not know, saved unchanged. */
  private unknown: YamlMapping = {};

  /** `finish` is called when the tool's work is done, so that the previous tool is used again. */
  constructor(
    protected readonly context: ToolContext,
    protected readonly finish: () => void,
  ) {}

  abstract activate(): void;
  abstract deactivate(): void;
  abstract pointer(input: PointerInput): boolean;

  protected add<P extends Property<unknown>>(property: P): P {
    this.properties.push(property);
    return property;
  }

  /** A header with the fixed frame and the time now. */
  protected header(): RosMessage {
    return { seq: 0, stamp: timeOf(this.context.connection.now()), frame_id: this.context.fixedFrame.peek() };
  }

  save(): YamlMapping {
    const saved: Record<string, Yaml> = { ...this.unknown, Class: this.className };
    for (const property of this.properties) {
      const yaml = property.save();
      if (yaml !== undefined) saved[property.name] = yaml;
    }
    return saved;
  }

  load(yaml: YamlMapping): string[] {
    const faults: string[] = [];
    const unknown: Record<string, Yaml> = {};
    for (const [key, value] of Object.entries(yaml)) {
      const property = this.properties.find(({ name }) => name === key);
      if (property !== undefined) faults.push(...property.load(value).map((fault) => `${this.name}/${fault}`));
      else if (key !== "Class") unknown[key] = value;
    }
    this.unknown = unknown;
    return faults;
  }
}
