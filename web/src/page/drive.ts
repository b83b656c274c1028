/** Driving with a dead man's switch: commands are renewed at 10 Hz while a control is held, then released. */

import { computed, effect, signal } from "@preact/signals";

import { isWatcher } from "../protocol/watchers";
import type { Connection } from "../protocol/connection";
import type { PageSession } from "../protocol/generated/page_messages";
import { isNumber, recall, remember } from "./storage";

const PERIOD = 100; // ms
const TWISTS = ["geometry_msgs/Twist", "geometry_msgs/TwistStamped"];
/** Conventional name of velocity topics, for subscribers whose type is unknown. */
const BY_NAME = /(^|\/)cmd_vel$/;

/** Input of a control: ratios −1…1 of the velocity limits. */
export interface DriveInput {
  readonly linear: number;
  readonly angular: number;
}

export class Drive {
  private readonly chosen = signal<string | null>(null);
  private readonly inputs = signal<ReadonlyMap<string, DriveInput>>(new Map());
  private driven: string | null = null;
  private known: readonly string[] = [];
  private timer: ReturnType<typeof setInterval> | undefined;

  /** Velocity topics with a subscriber other than watchers, the session's first. */
  readonly topics = computed<readonly string[]>(() => {
    const { connection, session } = this.page;
    if (session.view_only) return [];
    const { types, subscribers } = connection.graph.value;
    const published = [...connection.topics.value.values()].map(({ name, type }) => [name, type] as const);
    const typed = [...published, ...types].flatMap(([name, type]) => (TWISTS.includes(type) ? [name] : []));
    const named = [...subscribers.keys()].filter((name) => BY_NAME.test(name));
    const hasListener = (name: string): boolean =>
      (subscribers.get(name) ?? []).some((node) => node !== session.node && !isWatcher(node));
    const isFirst = (name: string): number => Number(name !== session.drive_topic);
    const isUntold = types.size + subscribers.size === 0; // after a reconnection, topics arrive before the graph
    if (isUntold || connection.state.value.kind !== "connected") return this.known;
    this.known = [...new Set([...typed, ...named].filter(hasListener))].sort(
      (a, b) => isFirst(a) - isFirst(b) || (a < b ? -1 : 1),
    );
    return this.known;
  });
  /** The topic that is driven; null: there is none. */
  readonly topic = computed(() => this.chosen.value ?? this.topics.value[0] ?? null);
  /** Largest velocities [m/s], [rad/s]. */
  readonly linearLimit;
  readonly angularLimit;
  /** Commanded velocities [m/s], [rad/s]; null: no control is held. */
  readonly command = computed<DriveInput | null>(() => {
    if (this.inputs.value.size === 0) return null;
    const sum = (part: keyof DriveInput): number =>
      clamp([...this.inputs.value.values()].reduce((total, input) => total + input[part], 0));
    return { linear: sum("linear") * this.linearLimit.value, angular: sum("angular") * this.angularLimit.value };
  });

  /** Delay of the commands [s]; 0: they arrive in time. */
  readonly delay = computed(() => (this.command.value === null ? 0 : this.page.connection.driveDelay.value));

  constructor(private readonly page: { readonly connection: Connection; readonly session: PageSession }) {
    const key = page.session.robot ?? page.session.title;
    this.linearLimit = signal(recall(`drive.${key}.linear`, 0.5, isNumber));
    this.angularLimit = signal(recall(`drive.${key}.angular`, 1, isNumber));
    effect(() => remember(`drive.${key}.linear`, this.linearLimit.value));
    effect(() => remember(`drive.${key}.angular`, this.angularLimit.value));
    effect(() => {
      if (this.topic.value !== null) page.connection.prepareDriving();
    });
    effect(() => {
      if (page.connection.state.value.kind !== "connected") this.releaseAll();
    });
  }

  choose(topic: string): void {
    this.releaseAll();
    this.chosen.value = topic;
  }

  /** Hold a key, the disc or a stick; ignored without a connection or topic. */
  hold(source: string, linear: number, angular: number): void {
    if (this.topic.peek() === null || this.page.connection.state.peek().kind !== "connected") return;
    const isNew = !this.inputs.peek().has(source);
    this.inputs.value = new Map(this.inputs.peek()).set(source, { linear: clamp(linear), angular: clamp(angular) });
    if (this.driven === null) {
      this.driven = this.topic.peek();
      this.timer = setInterval(() => this.send(), PERIOD);
    }
    if (isNew) this.send(); // a held control's changes are sent at 10 Hz
  }

  release(source: string): void {
    if (!this.inputs.peek().has(source)) return;
    const inputs = new Map(this.inputs.peek());
    inputs.delete(source);
    this.inputs.value = inputs;
    if (inputs.size === 0) this.stop();
    else this.send();
  }

  releaseAll(): void {
    if (this.inputs.peek().size > 0) this.inputs.value = new Map();
    this.stop();
  }

  private send(): void {
    const command = this.command.peek();
    if (command !== null && this.driven !== null)
      this.page.connection.drive(this.driven, command.linear, command.angular);
  }

  private stop(): void {
    clearInterval(this.timer);
    if (this.driven !== null) this.page.connection.release();
    this.driven = null;
  }
}

function clamp(share: number): number {
  return Math.min(1, Math.max(-1, share));
}
