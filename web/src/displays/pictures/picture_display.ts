/** Base of displays of an image topic: rviz's ImageDisplayBase. */

import { computed, effect, signal, untracked, type ReadonlySignal } from "@preact/signals";

import { Display, type DisplayContext } from "../display";
import { BoolProperty, EnumProperty, IntProperty, TopicProperty } from "../../rviz/properties";
import { PictureStream, type Picture, type PictureSource } from "./picture_stream";

/** Wall seconds between updates of the count of images. */
const COUNT_PERIOD_S = 0.25;
const TRANSPORTS = ["raw", "compressed"];

export abstract class PictureDisplay extends Display implements PictureSource {
  readonly topicProperty = this.add(
    new TopicProperty("Image Topic", "", ["sensor_msgs/Image", "sensor_msgs/CompressedImage"]),
  );
  readonly transport = this.add(
    new EnumProperty("Transport Hint", "raw", TRANSPORTS, {
      open: true,
      description: "Preferred method of sending images.",
    }),
  );
  /** Pictures of the topic; null while it is disabled. */
  protected readonly stream = signal<PictureStream | null>(null);
  private disposers: (() => void)[] = [];
  private sinceCount = 0;

  constructor(context: DisplayContext) {
    super(context);
    this.add(
      new IntProperty("Queue Size", 2, { min: 1, description: "Kept for rviz; here the newest image is shown." }),
    );
    this.add(
      new BoolProperty("Unreliable", false, {
        description: "Prefer UDP topic transport; kept for rviz, without effect here.",
      }),
    );
  }

  abstract readonly picture: ReadonlySignal<Picture | null>;

  /** The topic that is subscribed to: that of the transport below the image's. */
  private readonly source = computed(() => {
    const topic = this.context.names.resolve(this.topicProperty.value.value);
    const transport = this.transport.value.value;
    return topic === "" || transport === "raw" || topic.endsWith(`/${transport}`) ? topic : `${topic}/${transport}`;
  });

  override get topic(): string | null {
    return this.source.value || null;
  }

  /** Run while enabled, at once and whenever a signal that it reads changes. */
  protected whileEnabled(run: () => void): void {
    this.disposers.push(effect(run));
  }

  protected onStart(): void {
    this.whileEnabled(() => {
      const topic = this.source.value;
      untracked(() => this.open(topic));
    });
    this.whileEnabled(() => {
      const stream = this.stream.value;
      const fault = stream?.fault.value ?? null;
      const isFirst = stream?.picture.value != null && stream.count.peek() === 1;
      untracked(() => {
        if (fault !== null) this.setStatus("Image", "error", fault);
        else if (isFirst || this.statuses.peek().get("Image")?.level === "error") this.showCount();
      });
    });
  }

  protected onStop(): void {
    for (const dispose of this.disposers) dispose();
    this.disposers = [];
    this.open("");
  }

  override update(_now: bigint, elapsed: number): void {
    this.sinceCount += elapsed;
    if (this.sinceCount < COUNT_PERIOD_S) return;
    this.sinceCount = 0;
    if (this.stream.peek()?.fault.peek() === null) this.showCount();
  }

  private open(topic: string): void {
    this.stream.peek()?.close();
    this.stream.value = topic === "" ? null : new PictureStream(this.context.connection, topic);
    if (TRANSPORTS.includes(this.transport.value.peek())) this.clearStatus("Transport Hint");
    else
      this.setStatus(
        "Transport Hint",
        "error",
        `Transport ${this.transport.value.peek()} is not supported; use raw or compressed`,
      );
    this.showCount();
  }

  private showCount(): void {
    const count = this.stream.peek()?.count.peek() ?? 0;
    if (count > 0) this.setStatus("Image", "ok", `${count} images received`);
    else this.setStatus("Image", "warn", "No Image received", this.nothingAdvice());
  }

  private nothingAdvice(): string | undefined {
    const { topic } = this;
    if (topic === null) return "Choose a topic.";
    return this.context.connection.topics.peek().has(topic) ? undefined : `Nothing publishes ${topic}.`;
  }
}
