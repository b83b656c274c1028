/** Base of displays of one topic whose messages have a header: rviz's MessageFilterDisplay. */

import { effect, untracked, type ReadonlySignal } from "@preact/signals";

import { NoTransform, type Transform } from "../frames/transform";
import type { Received, Subscription } from "../protocol/connection";
import type { Header } from "../protocol/generated/ros_messages";
import { nanoseconds } from "../protocol/ros_types";
import { Display, type DisplayContext } from "./display";
import { MessageFilter } from "./message_filter";
import { BoolProperty, IntProperty, TopicProperty } from "../rviz/properties";

/** Wall seconds between updates of the count of messages. */
const COUNT_PERIOD_S = 0.25;

interface Transforms {
  readonly start: Transform;
  readonly end: Transform;
}

export interface Stamped {
  readonly header: Header;
}

export abstract class TopicDisplay<M extends Stamped> extends Display {
  readonly topicProperty: TopicProperty;
  readonly queueSize: IntProperty;
  private readonly filter: MessageFilter<M, Transforms>;
  private subscription: Subscription | null = null;
  private disposers: (() => void)[] = [];
  private received = 0;
  private sinceCount = 0;

  constructor(
    context: DisplayContext,
    private readonly types: readonly string[],
    topicName = "Topic",
  ) {
    super(context);
    this.topicProperty = this.add(
      new TopicProperty(topicName, "", types, { description: `${types.join(" or ")} topic to subscribe to.` }),
    );
    this.add(
      new BoolProperty("Unreliable", false, {
        description: "Prefer UDP topic transport; kept for rviz, without effect here.",
      }),
    );
    this.queueSize = this.add(
      new IntProperty("Queue Size", 10, { min: 0, description: "Messages that wait for their transforms." }),
    );
    this.filter = new MessageFilter(
      (message) => this.find(message),
      (message, transforms) => this.deliver(message, transforms),
      (reason) => this.setStatus("Transform", "error", reason.text, reason.advice),
    );
  }

  override get topic(): string | null {
    return this.context.names.resolve(this.topicProperty.value.value) || null;
  }

  /** Show a message; `transform` is its frame's in the fixed frame at its stamp, `end` the one at `endTime`. */
  protected abstract process(message: M, transform: Transform, end: Transform): void;
  /** Drop shown messages. */
  protected abstract clear(): void;

  /** The reason why a message cannot be shown, in rviz's words. */
  protected fault(_message: M): string | null {
    return null;
  }

  /** The frame that a message is in. */
  protected frameOf(message: M): string {
    return message.header.frame_id;
  }

  /** Time [ns] of the last of a message's measurements, where it is not the stamp. */
  protected endTime(_message: M): bigint | null {
    return null;
  }

  /** Run while enabled, at once and whenever a signal that it reads changes. */
  protected whileEnabled(run: () => void): void {
    this.atStop(effect(run));
  }

  protected atStop(dispose: () => void): void {
    this.disposers.push(dispose);
  }

  protected onStart(): void {
    this.whileEnabled(() => this.filter.setLimit(this.queueSize.value.value));
    this.whileEnabled(() => {
      const topic = this.topic ?? "";
      touch(this.context.fixedFrame);
      untracked(() => this.subscribe(topic));
    });
    this.whileEnabled(() => {
      const { topic } = this;
      const isKnown = topic !== null && this.context.connection.topics.value.has(topic);
      untracked(() => {
        if (this.received === 0) this.showNothingReceived(isKnown);
      });
    });
  }

  protected onStop(): void {
    for (const dispose of this.disposers) dispose();
    this.disposers = [];
    this.subscription?.close();
    this.subscription = null;
    this.forget();
  }

  override update(_now: bigint, elapsed: number): void {
    this.guard(() => this.filter.flush(elapsed));
    this.sinceCount += elapsed;
    if (this.sinceCount < COUNT_PERIOD_S) return;
    this.sinceCount = 0;
    if (this.received > 0 && this.statuses.peek().get("Topic")?.level === "ok") this.showCount();
  }

  private subscribe(topic: string): void {
    this.subscription?.close();
    this.subscription = null;
    this.forget();
    this.clearStatus("Transform");
    this.showNothingReceived(this.context.connection.topics.peek().has(topic));
    if (topic === "") return;
    this.subscription = this.context.connection.subscribe<M>(topic, (received) => this.receive(received), {
      onError: (text) => this.setStatus("Topic", "error", text),
    });
  }

  private forget(): void {
    this.received = 0;
    this.filter.clear();
    this.clear();
    this.context.scene.invalidate();
  }

  private showNothingReceived(isKnown: boolean): void {
    const { topic } = this;
    const advice = topic === null ? "Choose a topic." : `Nothing publishes ${topic}.`;
    if (isKnown) this.setStatus("Topic", "warn", "No messages received");
    else this.setStatus("Topic", "warn", "No messages received", advice);
  }

  private showCount(): void {
    this.setStatus("Topic", "ok", `${this.received} messages received`);
  }

  private receive({ type, message }: Received<M>): void {
    if (!this.types.includes(type)) {
      this.setStatus("Topic", "error", `${this.topic ?? ""} is of type ${type}, not ${this.types.join(" or ")}`);
      return;
    }
    this.received += 1;
    this.guard(() => {
      const fault = this.fault(message);
      if (fault !== null) {
        this.setStatus("Topic", "error", fault);
        return;
      }
      if (this.received === 1 || this.statuses.peek().get("Topic")?.level !== "ok") this.showCount();
      this.filter.add(message);
    });
  }

  /** Run, and report errors as a status: messages follow their publisher's definition, which may lack fields. */
  protected guard(run: () => void): void {
    try {
      run();
    } catch (error) {
      this.setStatus(
        "Topic",
        "error",
        `Message is not a ${this.types.join(" or ")} as it is known here: ${String(error)}`,
      );
    }
  }

  private find(message: M): Transforms | NoTransform {
    const { stamp } = message.header;
    const frame = this.frameOf(message);
    const fixed = this.context.fixedFrame.peek();
    const start = this.context.frames.lookup(fixed, frame, nanoseconds(stamp));
    if (start instanceof NoTransform) return start;
    const endTime = this.endTime(message);
    if (endTime === null) return { start, end: start };
    const end = this.context.frames.lookup(fixed, frame, endTime);
    return end instanceof NoTransform ? end : { start, end };
  }

  private deliver(message: M, { start, end }: Transforms): void {
    this.setStatus("Transform", "ok", "Transform OK");
    this.process(message, start, end);
    this.context.scene.invalidate();
  }
}

/** Read a signal, so that an effect runs when it changes. */
export function touch(signal: ReadonlySignal<unknown>): unknown {
  return signal.value;
}
