/** The list of displays with rviz's global options, loaded from and saved as an .rviz file. */

import { computed, signal, type ReadonlySignal, type Signal } from "@preact/signals";

import type { UndoStack } from "./undo_stack";
import { DEFAULT_FILE, RvizFile, RvizFileError, type RvizContent } from "../rviz/rviz_file";
import type { Views } from "../scene/view_controller";
import type { Display, DisplayContext, Status } from "./display";
import type { DisplayList, Offer, Unsupported } from "./display_list";
import { Edits } from "./edits";
import { workOutFixedFrame } from "./fixed_frame";
import { Group, isDisplay, type Entry, type UnsupportedEntry } from "./group";
import { findOffers } from "./offers";
import {
  BoolProperty,
  ColorProperty,
  IntProperty,
  TopicProperty,
  type Yaml,
  type YamlMapping,
} from "../rviz/properties";
import { displayClass, displayClasses } from "./registry";

/** Tools as a list of the file. */
interface SavedTools {
  save(): readonly YamlMapping[];
  load(yaml: readonly YamlMapping[]): string[];
}

/** Parts of the page that the list uses. */
export interface DisplayStoreParts extends Omit<DisplayContext, "fixedFrame" | "displays"> {
  readonly undo: UndoStack;
  readonly views: Pick<Views, "save" | "load">;
  readonly tools: SavedTools;
}

export class DisplayStore implements DisplayList {
  readonly fixedFrameSetting: Signal<string> = signal("");
  readonly fixedFrame: ReadonlySignal<string>;
  readonly fixedFrameStatus: ReadonlySignal<Status>;
  readonly backgroundColor = new ColorProperty("Background Color", [48, 48, 48]);
  readonly frameRate = new IntProperty("Frame Rate", 30, { min: 1, max: 1000, unit: "Hz" });
  readonly defaultLight = new BoolProperty("Default Light", true);
  readonly displays: ReadonlySignal<readonly Display[]>;
  readonly unsupported: ReadonlySignal<readonly Unsupported[]>;
  readonly offers: ReadonlySignal<readonly Offer[]>;
  readonly changes: ReadonlySignal<number>;

  private readonly root: Group;
  private readonly context: DisplayContext;
  private file = RvizFile.parse(DEFAULT_FILE);
  private readonly edits: Edits;
  /** Views as text when the file was loaded or saved; null: no file. */
  private readonly savedLook = signal<string | null>(null);

  constructor(private readonly parts: DisplayStoreParts) {
    const { connection, names, frames, scene, axisColors, ghostShapes } = parts;
    const workedOut = computed(() => (frames.frames.value.length === 0 ? "map" : workOutFixedFrame(frames.describe())));
    this.fixedFrame = computed(() => plain(this.fixedFrameSetting.value) || workedOut.value);
    this.fixedFrameStatus = computed(() => frameStatus(this.fixedFrame.value, frames.frames.value));
    this.displays = computed(() => this.root.displays);
    const { displays, fixedFrame } = this;
    this.context = { connection, names, frames, scene, axisColors, ghostShapes, displays, fixedFrame };
    this.root = new Group(this.context);
    this.unsupported = computed(() => unsupportedOf(this.root));
    this.offers = computed(() => {
      const shown = new Set(this.root.all.map((display) => display.topic ?? ""));
      return findOffers(connection.topics.value.values(), shown);
    });
    this.edits = new Edits(parts.undo);
    this.changes = computed(
      () => this.edits.count.value + Number(this.savedLook.value !== null && this.lookText() !== this.savedLook.value),
    );
    this.load(DEFAULT_FILE);
    this.savedLook.value = null;
    this.root.start();
  }

  get classes(): readonly string[] {
    return displayClasses()
      .map((entry) => entry.className)
      .sort();
  }

  add(className: string, topic?: string): Display {
    const display = this.create(className);
    display.name.value = this.freeName(display.className.split("/")[1] ?? className);
    const topicProperty = display.properties.find((property) => property instanceof TopicProperty);
    if (topic !== undefined) topicProperty?.decode(topic);
    this.insert(`Add ${display.name.peek()}`, display, this.root.entries.peek().length, this.root);
    return display;
  }

  remove(display: Display): void {
    const [group, index] = this.find(display);
    this.edit(
      `Remove ${display.name.peek()}`,
      () => group.remove(display),
      () => group.insert(display, index),
    );
  }

  duplicate(display: Display): Display {
    const copy = this.create(display.className);
    copy.load(display.save());
    copy.name.value = this.freeName(`Copy of ${display.name.peek()}`);
    const [group, index] = this.find(display);
    this.insert(`Duplicate ${display.name.peek()}`, copy, index + 1, group);
    return copy;
  }

  move(display: Display, to: number): void {
    const [group, from] = this.find(display);
    const moveTo = (index: number): void => {
      group.remove(display);
      group.insert(display, index);
    };
    this.edit(
      `Move ${display.name.peek()}`,
      () => moveTo(to),
      () => moveTo(from),
    );
  }

  reset(): void {
    for (const display of this.root.displays) display.reset();
  }

  update(now: bigint, elapsed: number): void {
    this.root.update(now, elapsed);
  }

  load(text: string): readonly string[] {
    let file: RvizFile;
    try {
      file = RvizFile.parse(text);
    } catch (error) {
      if (error instanceof RvizFileError) return [error.message];
      throw error;
    }
    const content = file.content();
    this.file = file;
    const faults = [...this.loadGlobalOptions(content.globalOptions)];
    faults.push(...this.root.load({ Displays: content.displays, Enabled: true }));
    if (Object.keys(content.views).length > 0) faults.push(...this.parts.views.load(content.views));
    if (content.tools.length > 0) faults.push(...this.parts.tools.load(content.tools));
    this.markSaved();
    return faults;
  }

  save(): string {
    return this.file.write(this.content());
  }

  markSaved(): void {
    this.edits.markSaved();
    this.savedLook.value = this.lookText();
  }

  edit(title: string, redo: () => void, undo: () => void): void {
    this.edits.run(title, redo, undo);
  }

  /** Views of all panes as text. */
  private lookText(): string {
    return JSON.stringify({ ...this.parts.views.save(), Saved: null });
  }

  private content(): RvizContent {
    const displays = this.root.save()["Displays"];
    const globalOptions: Record<string, Yaml> = {};
    for (const option of [this.backgroundColor, this.defaultLight, this.frameRate])
      globalOptions[option.name] = option.encode();
    if (this.fixedFrameSetting.value !== "") globalOptions["Fixed Frame"] = this.fixedFrameSetting.value;
    return {
      globalOptions,
      displays: Array.isArray(displays) ? (displays as readonly Yaml[]) : [],
      views: this.parts.views.save(),
      tools: this.parts.tools.save(),
    };
  }

  private loadGlobalOptions(options: YamlMapping): string[] {
    const frame = options["Fixed Frame"];
    this.fixedFrameSetting.value = typeof frame === "string" ? frame : "";
    return [this.backgroundColor, this.defaultLight, this.frameRate].flatMap((option) => {
      const value = options[option.name];
      if (value === undefined) option.value.value = option.initial;
      return value === undefined ? [] : option.load(value).map((fault) => `Global Options: ${fault}`);
    });
  }

  private create(className: string): Display {
    const entry = displayClass(className);
    if (entry === undefined) throw new Error(`there is no display ${className}`);
    return entry.create(this.context);
  }

  private insert(title: string, entry: Entry, index: number, group: Group): void {
    this.edit(
      title,
      () => group.insert(entry, index),
      () => group.remove(entry),
    );
  }

  /** Group that holds a display, and the display's index. */
  private find(display: Display): readonly [Group, number] {
    const groups = [this.root, ...this.root.all.filter((other) => other instanceof Group)];
    for (const group of groups) {
      const index = group.entries.peek().indexOf(display);
      if (index >= 0) return [group, index];
    }
    return [this.root, this.root.entries.peek().length];
  }

  private freeName(name: string): string {
    const taken = new Set(this.root.all.map((display) => display.name.peek()));
    if (!taken.has(name)) return name;
    let number = 2;
    while (taken.has(`${name} ${number}`)) number++;
    return `${name} ${number}`;
  }
}

/** A frame without the slash of tf. */
function plain(frame: string): string {
  return frame.replace(/^\//, "");
}

function frameStatus(frame: string, frames: readonly string[]): Status {
  if (frames.includes(frame)) return { level: "ok", text: "OK" };
  const missing = `Fixed Frame [${frame}] does not exist`;
  if (frames.length === 0) return { level: "warn", text: `No tf data. Actual error: ${missing}` };
  return { level: "error", text: missing, advice: `Frames here: ${frames.join(", ")}` };
}

function unsupportedOf(group: Group): readonly UnsupportedEntry[] {
  return group.entries.value.flatMap((entry) => {
    if (!isDisplay(entry)) return [entry];
    return entry instanceof Group ? unsupportedOf(entry) : [];
  });
}
