/** Marker and MarkerArray: shapes that nodes publish, by namespace. */

import { effect, untracked } from "@preact/signals";

import { NoTransform, type Transform } from "../frames/transform";
import type { Received, Subscription } from "../protocol/connection";
import type { Marker, MarkerArray } from "../protocol/generated/ros_messages";
import { nanoseconds } from "../protocol/ros_types";
import { Display, type DisplayContext } from "./display";
import { KeyedProperty } from "./keyed_property";
import { checkMarker } from "./markers/marker_checks";
import { MarkerScene } from "./markers/marker_scene";
import { Action, markerName } from "./markers/marker_type";
import { BoolProperty, IntProperty, TopicProperty } from "../rviz/properties";
import { register } from "./registry";
import { watch } from "./watch";

/** Wall seconds after which a marker that waits for its transform says so. */
const PATIENCE_S = 1;

interface Waiting {
  readonly marker: Marker;
  waited: number;
}

abstract class MarkerBase extends Display {
  readonly topicProperty: TopicProperty;
  private readonly queueSize: IntProperty;
  readonly namespaces: KeyedProperty<BoolProperty>;
  private scene: MarkerScene | null = null;
  private readonly waiting = new Map<string, Waiting>();
  private subscriptions: Subscription[] = [];
  private stops: (() => void)[] = [];
  private received = 0;

  constructor(context: DisplayContext, topic: string, types: readonly string[]) {
    super(context);
    this.topicProperty = this.add(new TopicProperty("Marker Topic", topic, types));
    this.queueSize = this.add(new IntProperty("Queue Size", 100, { min: 0 }));
    this.namespaces = this.add(new KeyedProperty<BoolProperty>("Namespaces"));
  }

  override get topic(): string {
    return this.context.names.resolve(this.topicProperty.value.value);
  }

  /** Topics to listen to; rviz's Marker hears the topic of arrays, too. */
  protected abstract topics(): readonly string[];

  protected onStart(): void {
    const { connection, scene: view } = this.context;
    const scene = new MarkerScene({
      connection,
      onFault: (marker, text, advice) => this.setStatus(markerName(marker), "error", text, advice),
      onChange: () => view.invalidate(),
    });
    this.scene = scene;
    this.root.add(scene);
    this.stops = [
      effect(() => this.resubscribe(this.topics())),
      watch([this.namespaces], () => {
        for (const [name, row] of this.namespaces.entries()) scene.setVisible(name, row.value.peek());
      }),
      this.context.fixedFrame.subscribe(() => scene.follow("all", (marker) => this.find(marker))),
    ];
  }

  protected onStop(): void {
    for (const stop of this.stops) stop();
    for (const subscription of this.subscriptions) subscription.close();
    this.subscriptions = [];
    this.waiting.clear();
    this.scene?.dispose();
    this.scene = null;
    this.root.clear();
    this.received = 0;
  }

  override update(now: bigint, elapsed: number): void {
    const { scene } = this;
    if (scene === null) return;
    scene.expire(now, (name) => this.clearStatus(name));
    for (const [name, waiting] of this.waiting) this.retry(name, waiting, now, elapsed);
    scene.follow("locked", (marker) => this.find(marker));
    if (scene.refresh()) this.context.scene.invalidate();
  }

  private resubscribe(topics: readonly string[]): void {
    untracked(() => {
      for (const subscription of this.subscriptions) subscription.close();
      this.scene?.deleteAll();
      this.waiting.clear();
      this.statuses.value = new Map();
      this.received = 0;
      this.setStatus("Topic", "warn", "No messages received", `Nothing has come on ${topics[0] ?? "a topic"} yet.`);
      this.subscriptions = topics
        .filter((topic) => topic !== "")
        .map((topic) =>
          this.context.connection.subscribe<Marker | MarkerArray>(topic, (received) => this.receive(received), {
            every: true,
            onError: (text) => this.setStatus("Topic", "error", text),
          }),
        );
    });
  }

  private receive({ message }: Received<Marker | MarkerArray>): void {
    this.received++;
    this.setStatus("Topic", "ok", "OK");
    const markers = "markers" in message ? message.markers : [message];
    const now = this.context.connection.now();
    for (const marker of markers) this.take(marker, now);
    const limit = Math.max(this.queueSize.value.peek() || Infinity, markers.length);
    for (const name of this.waiting.keys()) {
      if (this.waiting.size <= limit) break;
      this.waiting.delete(name);
    }
  }

  private take(marker: Marker, now: bigint): void {
    const name = markerName(marker);
    if (marker.action === Action.deleteAll) {
      this.scene?.deleteAll();
      this.waiting.clear();
      this.forgetStatuses();
      return;
    }
    this.waiting.delete(name);
    if (marker.action === Action.delete) {
      this.scene?.delete(name);
      this.clearStatus(name);
      return;
    }
    const fault = checkMarker(marker);
    if (fault === null) this.clearStatus(name);
    else this.setStatus(name, fault.level, fault.text);
    if (fault?.level === "error") this.scene?.delete(name);
    else this.show(name, marker, now);
  }

  private show(name: string, marker: Marker, now: bigint): void {
    const frame = this.lookup(marker);
    if (frame instanceof NoTransform) {
      this.waiting.set(name, { marker, waited: 0 });
      return;
    }
    const row = this.namespaces.row(marker.ns, () => new BoolProperty(marker.ns, true));
    this.scene?.put(marker, frame, now, row.value.peek());
  }

  private retry(name: string, waiting: Waiting, now: bigint, elapsed: number): void {
    const frame = this.lookup(waiting.marker);
    if (!(frame instanceof NoTransform)) {
      this.waiting.delete(name);
      this.clearStatus(name);
      this.show(name, waiting.marker, now);
      return;
    }
    const wasPatient = waiting.waited < PATIENCE_S;
    waiting.waited += elapsed;
    if (wasPatient && waiting.waited >= PATIENCE_S) this.setStatus(name, "error", frame.text, frame.advice);
  }

  /** Pose of the marker's frame: of its stamp, or of now where it is locked to its frame. */
  private lookup(marker: Marker): Transform | NoTransform {
    const time = marker.frame_locked ? 0n : nanoseconds(marker.header.stamp);
    return this.context.frames.lookup(this.context.fixedFrame.peek(), marker.header.frame_id, time);
  }

  private find(marker: Marker): Transform | null {
    const transform = this.lookup(marker);
    if (!(transform instanceof NoTransform)) return transform;
    this.setStatus(markerName(marker), "error", transform.text, transform.advice);
    return null;
  }

  private forgetStatuses(): void {
    const topic = this.statuses.peek().get("Topic");
    this.statuses.value = topic === undefined ? new Map() : new Map([["Topic", topic]]);
  }
}

export class MarkerDisplay extends MarkerBase {
  readonly className = "rviz/Marker";

  constructor(context: DisplayContext) {
    super(context, "visualization_marker", ["visualization_msgs/Marker"]);
  }

  protected topics(): readonly string[] {
    const name = this.topicProperty.value.value;
    return name === "" ? [] : [name, `${name}_array`].map((topic) => this.context.names.resolve(topic));
  }
}

export class MarkerArrayDisplay extends MarkerBase {
  readonly className = "rviz/MarkerArray";

  constructor(context: DisplayContext) {
    super(context, "visualization_marker_array", ["visualization_msgs/MarkerArray"]);
  }

  protected topics(): readonly string[] {
    return [this.topic];
  }
}

register({
  className: "rviz/Marker",
  aliases: [],
  types: ["visualization_msgs/Marker"],
  create: (context) => new MarkerDisplay(context),
});
register({
  className: "rviz/MarkerArray",
  aliases: [],
  types: ["visualization_msgs/MarkerArray"],
  create: (context) => new MarkerArrayDisplay(context),
});
