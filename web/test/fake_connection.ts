/** A `Connection` without a server: tests put messages in and read what was sent. */

import { signal } from "@preact/signals";

import { readPayload } from "../src/protocol/check";
import type {
  Answer,
  Connection,
  ConnectionState,
  Fields,
  GraphInfo,
  Lag,
  ParameterValue,
  Received,
  RequestName,
  ServiceInfo,
  Subscription,
  TopicInfo,
  TopicStatistics,
} from "../src/protocol/connection";
import { channels } from "../src/protocol/generated/page_checks";
import type { Channels, SharedSelection } from "../src/protocol/generated/page_messages";
import type { RosMessage } from "../src/protocol/ros_types";

interface Subscriber {
  readonly onMessage: (received: Received<never>) => void;
  readonly onError: ((text: string) => void) | undefined;
}

export class FakeConnection implements Connection {
  readonly state = signal<ConnectionState>({ kind: "connected" });
  readonly lag = signal<Lag | null>(null);
  readonly topics = signal<ReadonlyMap<string, TopicInfo>>(new Map());
  readonly services = signal<ReadonlyMap<string, ServiceInfo>>(new Map());
  readonly parameters = signal<ReadonlyMap<string, ParameterValue>>(new Map());
  readonly floatParameters = signal<ReadonlySet<string>>(new Set());
  readonly graph = signal<GraphInfo>({
    types: new Map(),
    publishers: new Map(),
    subscribers: new Map(),
    services: new Map(),
  });
  readonly notices = signal<
    readonly { readonly level: "info" | "warning" | "error"; readonly text: string; readonly id?: string | undefined }[]
  >([]);

  /** ROS time [ns]; a test sets it. */
  time = 0n;
  readonly published: { readonly topic: string; readonly type: string; readonly message: RosMessage }[] = [];
  readonly requests: { readonly name: RequestName; readonly fields: Readonly<Record<string, unknown>> }[] = [];
  readonly calls: { readonly name: string; readonly request: RosMessage }[] = [];
  readonly driven: { readonly topic: string; readonly linear: number; readonly angular: number }[] = [];
  released = 0;
  readonly driveDelay = signal(0);
  isReadyToDrive = false;
  /** What the others were shown of the selection. */
  readonly presented: (SharedSelection | null)[] = [];
  /** Texts of types' definitions. */
  readonly definitions = new Map<string, string>();
  readonly assets = new Map<string, ArrayBuffer>();
  readonly answers = new Map<string, (request: RosMessage) => RosMessage>();

  readonly #subscribers = new Map<string, Set<Subscriber>>();
  readonly #raw = new Map<string, Set<(payload: DataView) => void>>();
  readonly #counts = new Map<string, number>();

  /** A topic appears. */
  advertise(name: string, type: string): void {
    this.topics.value = new Map(this.topics.peek()).set(name, { name, type, encoding: "ros1" });
  }

  /** A node subscribes to a topic that others publish or not. */
  listen(name: string, type: string, node = "/base"): void {
    const { types, subscribers, ...others } = this.graph.peek();
    const nodes = [...(subscribers.get(name) ?? []), node];
    this.graph.value = {
      ...others,
      types: new Map(types).set(name, type),
      subscribers: new Map(subscribers).set(name, nodes),
    };
  }

  /** A message arrives. */
  receive(topic: string, message: unknown, options: { readonly bytes?: number; readonly time?: bigint } = {}): void {
    this.#counts.set(topic, (this.#counts.get(topic) ?? 0) + 1);
    const received = {
      topic,
      type: this.topics.peek().get(topic)?.type ?? "",
      message: message as never,
      time: options.time ?? this.time,
      bytes: options.bytes ?? 0,
    };
    for (const subscriber of this.#subscribers.get(topic) ?? []) subscriber.onMessage(received);
  }

  /** A message arrives that cannot be decoded. */
  fail(topic: string, text: string): void {
    for (const subscriber of this.#subscribers.get(topic) ?? []) subscriber.onError?.(text);
  }

  /** A payload of one of the server's own channels arrives. */
  receiveRaw(topic: string, payload: DataView): void {
    for (const onPayload of this.#raw.get(topic) ?? []) onPayload(payload);
  }

  /** How many subscriptions a topic has. */
  subscriptions(topic: string): number {
    return (this.#subscribers.get(topic)?.size ?? 0) + (this.#raw.get(topic)?.size ?? 0);
  }

  now(): bigint {
    return this.time;
  }

  subscribe<M = RosMessage>(
    topic: string,
    onMessage: (received: Received<M>) => void,
    options: { readonly every?: boolean; readonly onError?: (text: string) => void } = {},
  ): Subscription {
    return enter(this.#subscribers, topic, { onMessage, onError: options.onError });
  }

  subscribeRaw(topic: string, onPayload: (payload: DataView) => void): Subscription {
    return enter(this.#raw, topic, onPayload);
  }

  subscribeJson<T extends keyof Channels>(topic: T, onMessage: (message: Channels[T]) => void): Subscription {
    return this.subscribeRaw(topic, (payload) => onMessage(readPayload(payload, topic, channels[topic])));
  }

  statistics(topic: string): TopicStatistics {
    return { rate: null, bandwidth: 0, lastAt: null, count: this.#counts.get(topic) ?? 0, dropped: 0 };
  }

  definition(type: string): Promise<string> {
    const text = this.definitions.get(type);
    return text === undefined ? Promise.reject(new Error(`there is no type ${type}`)) : Promise.resolve(text);
  }

  publish(topic: string, type: string, message: RosMessage): void {
    this.published.push({ topic, type, message });
  }

  callService(name: string, request: RosMessage): Promise<RosMessage> {
    this.calls.push({ name, request });
    const answer = this.answers.get(name);
    if (answer === undefined) return Promise.reject(new Error(`there is no service ${name}`));
    return Promise.resolve(answer(request));
  }

  setParameter(name: string, value: ParameterValue | undefined): void {
    const parameters = new Map(this.parameters.peek());
    if (value === undefined) parameters.delete(name);
    else parameters.set(name, value);
    this.parameters.value = parameters;
  }

  fetchAsset(uri: string): Promise<ArrayBuffer> {
    const bytes = this.assets.get(uri);
    return bytes === undefined ? Promise.reject(new Error(`there is no ${uri}`)) : Promise.resolve(bytes);
  }

  request<N extends RequestName>(name: N, fields: Fields<N>): Promise<Answer<N>> {
    this.requests.push({ name, fields: { ...fields } });
    return Promise.resolve({} as Answer<N>); // as of what is only done; tests of others answer themselves
  }

  drive(topic: string, linear: number, angular: number): void {
    this.driven.push({ topic, linear, angular });
  }

  prepareDriving(): void {
    this.isReadyToDrive = true;
  }
  release(): void {
    this.released += 1;
  }
  readonly typed: {
    readonly number: number;
    readonly text: string;
    readonly size: readonly [number, number] | undefined;
  }[] = [];
  useTerminal(number: number, text: string, size?: readonly [number, number]): void {
    this.typed.push({ number, text, size });
  }
  present(selection: SharedSelection | null): void {
    this.presented.push(selection);
  }
}

/** Add a value to a topic's set until the subscription is closed. */
function enter<T>(sets: Map<string, Set<T>>, topic: string, value: T): Subscription {
  const set = sets.get(topic) ?? new Set<T>();
  sets.set(topic, set.add(value));
  return { close: () => void set.delete(value) };
}
