/** Base of all displays. */

import { signal, type ReadonlySignal } from "@preact/signals";
import { Group, type Object3D } from "three";

import type { Connection, ParameterValue } from "../protocol/connection";
import type { GraphNames } from "../protocol/graph_names";
import type { FrameTree } from "../frames/frame_tree";
import { NoTransform, type Transform } from "../frames/transform";
import type { GhostShapes } from "../scene/world/ghost_shapes";
import type { SceneView } from "../scene/scene_view";
import type { StatusLevel } from "../rviz/status_level";
import type { AxisColors } from "../shapes/axes";
import { BoolProperty, isMapping, TopicProperty, type Property, type Yaml, type YamlMapping } from "../rviz/properties";

export interface Status {
  readonly level: StatusLevel;
  /** In rviz's words: "No messages received". */
  readonly text: string;
  /** Advice, if known. */
  readonly advice?: string;
}

/** Parts of the page that displays use. */
export interface DisplayContext {
  readonly connection: Connection;
  /** Namespace and remappings of the launch's rviz, by which names in the file are resolved. */
  readonly names: GraphNames;
  readonly frames: FrameTree;
  readonly scene: SceneView;
  /** All displays of the list, also those in groups. */
  readonly displays: ReadonlySignal<readonly Display[]>;
  readonly fixedFrame: ReadonlySignal<string>;
  /** Shapes of robots for the ghost of a recording. */
  readonly ghostShapes: GhostShapes;
  /** Colors of frames' axes. */
  readonly axisColors: ReadonlySignal<AxisColors>;
}

/**
 * A display: rviz's class of the same name.
 *
 * `root` stands in the scene while the display is enabled; the scene's axes are those of the fixed frame. Subclasses
 * declare properties as fields with `this.add(new …Property(…))`, in rviz's order.
 */
export abstract class Display {
  /** rviz's class: `rviz/LaserScan`. */
  abstract readonly className: string;
  readonly name = signal("");
  readonly enabled = new BoolProperty("Enabled", true);
  readonly properties: Property<unknown>[] = [];
  /** Status by its name in rviz ("Topic", "Transform [sender=unknown_publisher]"), in order of appearance. */
  readonly statuses = signal<ReadonlyMap<string, Status>>(new Map());
  /** Object that holds all that the display draws. */
  readonly root = new Group();
  /** Keys of the file that the page does not know, saved unchanged. */
  unknown: YamlMapping = {};

  constructor(protected readonly context: DisplayContext) {}

  /** The topic whose rate the display's row shows. */
  get topic(): string | null {
    return null;
  }

  /** Start: subscribe and show. Called when it is enabled. */
  start(): void {
    this.root.name = this.name.peek();
    this.context.scene.displays.add(this.root);
    this.onStart();
  }

  /** Stop: close subscriptions, drop the drawn objects. Called when it is disabled or removed. */
  stop(): void {
    this.onStop();
    this.context.scene.displays.remove(this.root);
    this.context.scene.invalidate();
    this.statuses.value = new Map();
  }

  /** Drop received messages, as rviz's Reset. */
  reset(): void {
    if (!this.enabled.value.value) return;
    this.stop();
    this.start();
  }

  protected abstract onStart(): void;
  protected abstract onStop(): void;
  /** Called once per frame while enabled; `now` is ROS time [ns], `elapsed` wall seconds since the last frame. */
  update(_now: bigint, _elapsed: number): void {
    // most displays change only when a message comes
  }

  /** Parameter of this name in the nearest enclosing namespace that has it, as searchParam finds it. */
  protected parameter(name: string): ParameterValue | undefined {
    const all = this.context.connection.parameters.value;
    const resolved = this.context.names.search(name).find((candidate) => all.has(candidate));
    return resolved === undefined ? undefined : all.get(resolved);
  }

  protected add<P extends Property<unknown>>(property: P): P {
    this.properties.push(property);
    return property;
  }

  /** Set one status; unchanged ones cost nothing. */
  protected setStatus(name: string, level: StatusLevel, text: string, advice?: string): void {
    const old = this.statuses.peek().get(name);
    if (old?.level === level && old.text === text && old.advice === advice) return;
    const statuses = new Map(this.statuses.peek());
    statuses.set(name, advice === undefined ? { level, text } : { level, text, advice });
    this.statuses.value = statuses;
  }

  /** Report an error of the display itself. */
  fail(error: unknown): void {
    this.setStatus("Display", "error", `It cannot be drawn: ${error instanceof Error ? error.message : String(error)}`);
  }

  protected clearStatus(name: string): void {
    if (!this.statuses.peek().has(name)) return;
    const statuses = new Map(this.statuses.peek());
    statuses.delete(name);
    this.statuses.value = statuses;
  }

  /** Pose of a frame in the fixed frame; null if there is none, which becomes the status "Transform". */
  protected transform(frame: string, time: bigint): Transform | null {
    const transform = this.context.frames.lookup(this.context.fixedFrame.peek(), frame, time);
    if (transform instanceof NoTransform) {
      this.setStatus("Transform", "error", transform.text, transform.advice);
      return null;
    }
    this.setStatus("Transform", "ok", "Transform OK");
    return transform;
  }

  /** Place an object at its pose in the fixed frame; without a pose it is hidden. */
  protected stand(object: Object3D, pose: Transform | null): void {
    const isPlaced = pose !== null;
    const isSame =
      object.visible === isPlaced &&
      (pose === null || (object.position.equals(pose.position) && object.quaternion.equals(pose.orientation)));
    if (isSame) return;
    object.visible = isPlaced;
    if (pose !== null) {
      object.position.copy(pose.position);
      object.quaternion.copy(pose.orientation);
    }
    this.context.scene.invalidate();
  }

  /** The most severe status. */
  get level(): StatusLevel {
    const levels = [...this.statuses.value.values()].map((status) => status.level);
    for (const level of ["error", "warn", "none", "ok"] as const) if (levels.includes(level)) return level;
    return "ok";
  }

  /** The display's entry of an .rviz file. */
  save(): YamlMapping {
    const saved: Record<string, Yaml> = { ...this.unknown, Class: this.className, Name: this.name.value };
    saved["Enabled"] = this.enabled.value.value;
    for (const property of this.properties) {
      const yaml = property.save();
      if (yaml !== undefined) saved[property.key] = yaml;
    }
    saved["Value"] = this.enabled.value.value;
    return saved;
  }

  /** Load an entry of an .rviz file; returns sentences about values that are not understood. */
  load(yaml: YamlMapping): string[] {
    const known = new Map(this.properties.map((property) => [property.name, property]));
    const faults: string[] = [];
    const unknown: Record<string, Yaml> = {};
    for (const [key, value] of Object.entries(yaml)) {
      const property = known.get(key) ?? this.topicOfRos2(key, value);
      if (property !== undefined) {
        property.key = key;
        faults.push(...property.load(value));
      } else if (key === "Name") this.name.value = typeof value === "string" ? value : JSON.stringify(value);
      else if (!["Class", "Enabled", "Value"].includes(key)) unknown[key] = value;
    }
    this.enabled.decode(yaml["Enabled"] ?? yaml["Value"] ?? false);
    this.unknown = unknown;
    return faults;
  }

  /** ROS 2's files have every display's topic, a name or a mapping, under `Topic`, whatever rviz calls it. */
  private topicOfRos2(key: string, value: Yaml): Property<unknown> | undefined {
    if (key !== "Topic" || !(isMapping(value) || typeof value === "string")) return undefined;
    return this.properties.find((property) => property instanceof TopicProperty);
  }
}
