/** The tools of the page, one of which is on. */

import { signal, type ReadonlySignal } from "@preact/signals";

import type { YamlMapping } from "../rviz/properties";
import type { BaseTool, ToolContext } from "./base_tool";
import { FocusCamera } from "./focus_camera";
import { InsertTool } from "./insert_tool";
import { Interact } from "./interact";
import { Measure } from "./measure";
import { MoveCamera } from "./move_camera";
import { MoveModel } from "./move_model";
import { PublishPoint } from "./publish_point";
import { PushModel } from "./push_model";
import { RotateModel } from "./rotate_model";
import { Select } from "./select";
import { SetGoal } from "./set_goal";
import { SetInitialPose } from "./set_initial_pose";
import type { ToolBox } from "../page/tool";
import type { PointerInput } from "../scene/pointer_input";

/** In rviz's order. */
const CLASSES = [Interact, MoveCamera, Select, FocusCamera, Measure, SetInitialPose, SetGoal, PublishPoint];
/** ROS 2's names that differ from rviz's. */
const ALIASES: Readonly<Record<string, string>> = { SetGoal2D: "SetGoal" };
/** Tools that stay on; after others, the last of these is used again. */
const LASTING: readonly string[] = [
  "rviz/Interact",
  "rviz/MoveCamera",
  "rviz/Select",
  "trundle/Move",
  "trundle/Rotate",
  "trundle/Push",
];

export class ToolList implements ToolBox {
  readonly tools: readonly BaseTool[];
  readonly insert: InsertTool | null;
  private readonly chosen;
  private lasting: string = "rviz/Interact";
  /** Entries of the file, in order, including unknown tools. */
  private entries: readonly YamlMapping[] = [];

  constructor(context: ToolContext) {
    const back = (): void => this.use(this.lasting);
    const [interact, ...others] = CLASSES.map((Class) => new Class(context, back));
    if (interact === undefined) throw new Error("there are no tools");
    const { editor } = context;
    const handling =
      editor === null ? [] : [MoveModel, RotateModel, PushModel].map((Class) => new Class(context, back, editor));
    this.insert = editor === null ? null : new InsertTool(context, back);
    this.tools = [interact, ...handling, ...others, ...(this.insert === null ? [] : [this.insert])];
    this.chosen = signal<BaseTool>(interact);
    this.start(interact);
  }

  get current(): ReadonlySignal<BaseTool> {
    return this.chosen;
  }

  use(className: string): void {
    const tool = this.tools.find((candidate) => candidate.className === className);
    if (tool === undefined || tool === this.chosen.peek()) return;
    this.chosen.peek().deactivate();
    this.chosen.value = tool;
    this.start(tool);
  }

  /** Offer an event to the current tool; true: it was the tool's. */
  pointer(input: PointerInput): boolean {
    return this.chosen.peek().pointer(input);
  }

  save(): readonly YamlMapping[] {
    const inFile = this.entries.map((entry) => this.find(classOf(entry)));
    const saved = this.entries.map(
      (entry, i): YamlMapping => ({ ...entry, ...inFile[i]?.save(), Class: classOf(entry) }),
    );
    const more = this.tools.filter((tool) => !inFile.includes(tool) && tool.className.startsWith("rviz/")); // rviz has no others
    return [...saved, ...more.map((tool) => tool.save())];
  }

  load(yaml: readonly YamlMapping[]): string[] {
    this.entries = yaml;
    return yaml.flatMap((entry) => {
      const tool = this.find(classOf(entry));
      return (tool?.load(entry) ?? [`there is no tool ${classOf(entry)}`]).map((fault) => `Tools: ${fault}`);
    });
  }

  private find(className: string): BaseTool | undefined {
    const [, short = ""] = className.split("/");
    const name = `rviz/${ALIASES[short] ?? short}`;
    return this.tools.find((tool) => tool.className === name);
  }

  private start(tool: BaseTool): void {
    if (LASTING.includes(tool.className)) this.lasting = tool.className;
    tool.activate();
  }
}

function classOf(entry: YamlMapping): string {
  return typeof entry["Class"] === "string" ? entry["Class"] : "";
}
