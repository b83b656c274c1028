/** InteractiveMarkers: markers that a person drags, clicks and opens menus of; servers get feedback. */

import { effect, untracked } from "@preact/signals";

import { NoTransform } from "../frames/transform";
import type { InteractiveMarker } from "../protocol/generated/ros_messages";
import { Display } from "./display";
import { withHandles } from "./interactive/default_handles";
import { withLocalShapes } from "./interactive/local_shapes";
import { MarkerClient } from "./interactive/marker_client";
import { InteractiveMarkerView } from "./interactive/marker_view";
import { BoolProperty, TopicProperty, type YamlMapping } from "../rviz/properties";
import { register } from "./registry";
import { watch } from "./watch";

const UPDATE = "visualization_msgs/InteractiveMarkerUpdate";
const FEEDBACK = "visualization_msgs/InteractiveMarkerFeedback";

export class InteractiveMarkers extends Display {
  readonly className = "rviz/InteractiveMarkers";
  readonly topicProperty = this.add(new TopicProperty("Update Topic", "", [UPDATE]));
  private readonly descriptions = this.add(new BoolProperty("Show Descriptions", true));
  private readonly axes = this.add(new BoolProperty("Show Axes", false));
  readonly visualAids = this.add(
    new BoolProperty("Show Visual Aids", false, { description: "Kept for rviz, without effect here." }),
  );
  private readonly transparency = this.add(new BoolProperty("Enable Transparency", true));

  private readonly views = new Map<string, InteractiveMarkerView>();
  /** Retries of markers whose shapes are in unknown frames. */
  private readonly waiting = new Map<string, () => void>();
  private client: MarkerClient | null = null;
  private stops: (() => void)[] = [];

  /** ROS 2's files name the markers' namespace; the topic is below it. */
  override load(yaml: YamlMapping): string[] {
    const space = yaml["Interactive Markers Namespace"];
    const isRos2 = yaml["Update Topic"] === undefined && typeof space === "string" && space !== "";
    return super.load(isRos2 ? { ...yaml, "Update Topic": `${space}/update` } : yaml);
  }

  override get topic(): string {
    return this.context.names.resolve(this.topicProperty.value.value);
  }

  protected onStart(): void {
    this.stops = [
      effect(() => {
        const topic = this.topicProperty.value.value;
        const isClear = this.transparency.value.value;
        untracked(() => this.connect(topic, isClear));
      }),
      watch([this.descriptions, this.axes], () => this.showAll()),
    ];
  }

  protected onStop(): void {
    for (const stop of this.stops) stop();
    this.disconnect();
  }

  override update(_now: bigint, elapsed: number): void {
    this.client?.tick(elapsed);
    for (const retry of [...this.waiting.values()]) retry();
    for (const [name, view] of this.views) {
      const fault = view.update(elapsed);
      if (fault === null) this.clearStatus(name);
      else this.setStatus(name, "error", fault.text, fault.advice);
    }
  }

  private connect(topic: string, isClear: boolean): void {
    this.disconnect();
    if (topic === "") {
      this.setStatus("Topic", "error", "Error subscribing: Empty topic name");
      return;
    }
    if (!topic.endsWith("/update")) {
      this.setStatus("Topic", "error", `Invalid topic name: ${topic}`, "Choose a topic whose name ends with /update.");
      return;
    }
    const { names } = this.context;
    const servers = topic.slice(0, -"/update".length);
    this.setStatus("General", "warn", "Waiting for messages.");
    this.client = new MarkerClient(
      this.context.connection,
      names.resolve(`${servers}/update_full`),
      names.resolve(topic),
      {
        put: (marker) => this.put(withHandles(marker, isClear ? 0.5 : 1), names.resolve(`${servers}/feedback`)),
        move: ({ name, pose }) => {
          this.views.get(name)?.setPose(pose);
          this.context.scene.invalidate();
        },
        erase: (name) => this.erase(name),
        status: (server, level, text) => {
          this.clearStatus("General");
          this.setStatus(server, level, text);
        },
      },
      (text) => this.setStatus("Topic", "error", text),
    );
  }

  private disconnect(): void {
    this.client?.close();
    this.client = null;
    for (const name of [...this.views.keys(), ...this.waiting.keys()]) this.erase(name);
    this.statuses.value = new Map();
  }

  private put(sent: InteractiveMarker, feedback: string): void {
    this.erase(sent.name);
    const { connection, scene, frames } = this.context;
    const marker = withLocalShapes(sent, frames);
    if (marker instanceof NoTransform) {
      this.setStatus(sent.name, "error", marker.text, marker.advice);
      this.waiting.set(sent.name, () => this.put(sent, feedback));
      return;
    }
    const parts = {
      connection,
      describe: () => ({ Marker: marker.name, Description: marker.description }),
      onFault: (_shape: unknown, text: string, advice: string) => this.setStatus(marker.name, "error", text, advice),
      onChange: () => scene.invalidate(),
    };
    const view = new InteractiveMarkerView(
      marker,
      this.context,
      parts,
      `/trundle_page/${this.name.peek()}`,
      (message) => connection.publish(feedback, FEEDBACK, message),
    );
    view.show({ descriptions: this.descriptions.value.peek(), axes: this.axes.value.peek() });
    this.views.set(marker.name, view);
    this.root.add(view);
    scene.invalidate();
  }

  private erase(name: string): void {
    this.waiting.delete(name);
    const view = this.views.get(name);
    if (view === undefined) return;
    this.views.delete(name);
    view.removeFromParent();
    view.dispose();
    this.clearStatus(name);
    this.context.scene.invalidate();
  }

  private showAll(): void {
    for (const view of this.views.values())
      view.show({ descriptions: this.descriptions.value.peek(), axes: this.axes.value.peek() });
    this.context.scene.invalidate();
  }
}

register({
  className: "rviz/InteractiveMarkers",
  aliases: [],
  types: [UPDATE],
  create: (context) => new InteractiveMarkers(context),
});
