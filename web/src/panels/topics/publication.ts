/** Messages that a person publishes on a topic: once, or at a rate. */

import { signal } from "@preact/signals";

import type { Connection } from "../../protocol/connection";
import { MessageType } from "../messages/definition";
import { FormState } from "../messages/form_state";
import { sentence } from "../use";

export const FASTEST = 100; // Hz: browsers' timers go no faster for long

export class Publication {
  /** Null until the definition has come. */
  readonly form = signal<FormState | null>(null);
  /** Error sentence; empty: no error. */
  readonly fault = signal("");
  readonly count = signal(0);
  readonly rate = signal(1);
  readonly isRunning = signal(false);
  private timer: ReturnType<typeof setInterval> | undefined;

  constructor(
    private readonly connection: Connection,
    readonly topic: string,
    readonly type: string,
  ) {
    connection.definition(type).then(
      (text) => (this.form.value = new FormState(MessageType.parse(text))),
      (error: unknown) => (this.fault.value = sentence(error)),
    );
  }

  /** Publish the form's message; an invalid field stops everything. */
  once(): void {
    const form = this.form.peek();
    if (form === null) return;
    const { message, faults } = form.build(this.connection.now());
    const [fault] = faults.values();
    this.fault.value = fault ?? "";
    if (fault !== undefined) {
      this.stop();
      return;
    }
    this.connection.publish(this.topic, this.type, message);
    this.count.value += 1;
  }

  /** Publish at the rate until `stop`, as `rostopic pub -r`. */
  start(): void {
    this.stop();
    this.isRunning.value = true;
    this.timer = setInterval(() => this.once(), 1000 / this.rate.peek());
    this.once();
  }

  stop(): void {
    clearInterval(this.timer);
    this.isRunning.value = false;
  }

  setRate(rate: number): void {
    this.rate.value = rate;
    if (this.isRunning.peek()) this.start();
  }
}
