/** A list of displays that draw nothing. */

import { signal } from "@preact/signals";

import type { UndoStack } from "../src/displays/undo_stack";
import { Display, type DisplayContext, type Status } from "../src/displays/display";
import type { StatusLevel } from "../src/rviz/status_level";
import type { DisplayList, Offer, Unsupported } from "../src/displays/display_list";
import {
  BoolProperty,
  ColorProperty,
  EnumProperty,
  FrameProperty,
  GroupProperty,
  IntProperty,
  NumberProperty,
  StringProperty,
  TopicProperty,
  VectorProperty,
  type Rgb,
} from "../src/rviz/properties";

export class FakeDisplay extends Display {
  override readonly className: string;
  readonly color: ColorProperty | null;

  constructor(
    context: DisplayContext,
    className: string,
    color: Rgb | null,
    private readonly onTopic: string | null,
  ) {
    super(context);
    this.className = className;
    this.name.value = className.replace("rviz/", "");
    if (onTopic !== null) this.add(new TopicProperty("Topic", onTopic, ["sensor_msgs/LaserScan"]));
    this.add(new EnumProperty("Style", "Flat Squares", ["Points", "Squares", "Flat Squares", "Spheres", "Boxes"]));
    this.add(new NumberProperty("Size (m)", 0.03, { min: 0.0001, unit: "m" }));
    this.add(new NumberProperty("Alpha", 1, { min: 0, max: 1 }));
    this.add(new IntProperty("Queue Size", 10, { min: 1 }));
    this.color = color === null ? null : this.add(new ColorProperty("Color", color));
    this.add(new VectorProperty("Offset", [0, 0, 0]));
    this.add(new BoolProperty("Selectable", true));
    this.add(new StringProperty("TF Prefix", ""));
    this.add(new FrameProperty("Reference Frame", "<Fixed Frame>"));
    const group = this.add(new GroupProperty("Links"));
    group.add(new BoolProperty("base_link", true)).add(new NumberProperty("Alpha", 1));
  }

  override get topic(): string | null {
    return this.onTopic;
  }

  status(level: StatusLevel, text: string, advice?: string): this {
    this.setStatus(level === "error" ? "Transform" : "Topic", level, text, advice);
    return this;
  }

  protected override onStart(): void {
    // nothing is drawn
  }
  protected override onStop(): void {
    // nothing is drawn
  }
}

export class FakeDisplayList implements DisplayList {
  readonly displays = signal<readonly FakeDisplay[]>([]);
  readonly unsupported = signal<readonly Unsupported[]>([]);
  readonly offers = signal<readonly Offer[]>([]);
  readonly fixedFrameSetting = signal("map");
  readonly fixedFrame = signal("map");
  readonly fixedFrameStatus = signal<Status>({ level: "ok", text: "OK" });
  readonly backgroundColor = new ColorProperty("Background Color", [22, 24, 27]);
  readonly frameRate = new IntProperty("Frame Rate", 30);
  readonly classes = ["rviz/Grid", "rviz/LaserScan", "rviz/Map", "rviz/Path", "rviz/Odometry"];
  readonly changes = signal(0);

  constructor(
    private readonly context: DisplayContext,
    private readonly undo: UndoStack,
  ) {}

  show(className: string, color: Rgb | null, topic: string | null): FakeDisplay {
    const display = new FakeDisplay(this.context, className, color, topic);
    this.displays.value = [...this.displays.value, display];
    return display;
  }

  add(className: string, topic?: string): FakeDisplay {
    const before = this.displays.peek();
    const display = new FakeDisplay(this.context, className, null, topic ?? null);
    this.undo.run(
      `Add ${display.name.peek()}`,
      () => (this.displays.value = [...before, display]),
      () => (this.displays.value = before),
    );
    return display;
  }
  remove(display: Display): void {
    this.displays.value = this.displays.value.filter((other) => other !== display);
  }
  duplicate(display: FakeDisplay): FakeDisplay {
    return this.show(display.className, null, display.topic);
  }
  move(display: FakeDisplay, to: number): void {
    const others = this.displays.value.filter((other) => other !== display);
    this.displays.value = [...others.slice(0, to), display, ...others.slice(to)];
  }
  reset(): void {
    for (const display of this.displays.value) display.reset();
  }
  update(): void {
    // nothing changes by itself
  }
  load(): [] {
    return [];
  }
  save(): string {
    return "Panels: []\n";
  }
  markSaved(): void {
    this.changes.value = 0;
  }
  edit(title: string, redo: () => void, undo: () => void): void {
    this.undo.run(title, redo, undo);
  }
}
