/** Interface of the connection to the page's server: the Foxglove protocol and what `trundle.v1` adds to it. */

import type { ReadonlySignal } from "@preact/signals";

import type { Channels, Requests, SharedSelection } from "./generated/page_messages";
import type { Json } from "./json";
import type { RosMessage } from "./ros_types";

export type ConnectionState =
  | { readonly kind: "connecting" }
  | { readonly kind: "connected" }
  | { readonly kind: "lost"; readonly retryInSeconds: number };

/** How late the page is. */
export interface Lag {
  readonly seconds: number;
  /** When the lag began, as `Date.now()` [ms]. */
  readonly since: number;
}

export interface TopicInfo {
  readonly name: string;
  /** Datatype, as `sensor_msgs/LaserScan`. */
  readonly type: string;
  readonly encoding: string;
}

export interface ServiceInfo {
  readonly name: string;
  readonly type: string;
  /** Text of the request's and the response's definition. */
  readonly request: string;
  readonly response: string;
}

/** Publishers, subscribers and servers: names of topics and services to names of nodes. */
export interface GraphInfo {
  /** Types of topics that are subscribed to, published or not. */
  readonly types: ReadonlyMap<string, string>;
  readonly publishers: ReadonlyMap<string, readonly string[]>;
  readonly subscribers: ReadonlyMap<string, readonly string[]>;
  readonly services: ReadonlyMap<string, readonly string[]>;
}

export interface TopicStatistics {
  /** Messages per second over the last seconds; null before the second message. */
  readonly rate: number | null;
  /** Bytes per second. */
  readonly bandwidth: number;
  /** Wall time at which the server had the last message, as `performance.now()` [ms]; null: none came. */
  readonly lastAt: number | null;
  readonly count: number;
  readonly dropped: number;
}

export interface Received<M> {
  readonly topic: string;
  readonly type: string;
  readonly message: M;
  /** Time at which the server received it [ns]. */
  readonly time: bigint;
  readonly bytes: number;
}

export interface Subscription {
  close(): void;
}

/** A dynamic parameter value as the protocol carries it. */
export type ParameterValue = Json;

export type RequestName = keyof Requests;
/** Fields of a request. */
export type Fields<N extends RequestName> = Requests[N]["fields"];
/** Answer to a request. */
export type Answer<N extends RequestName> = Requests[N]["answer"];
/** A request with its fields. */
export type Request = { [N in RequestName]: { readonly request: N; readonly fields: Fields<N> } }[RequestName];

export interface Connection {
  readonly state: ReadonlySignal<ConnectionState>;
  /** Null: the page is up to date. */
  readonly lag: ReadonlySignal<Lag | null>;
  readonly topics: ReadonlySignal<ReadonlyMap<string, TopicInfo>>;
  readonly services: ReadonlySignal<ReadonlyMap<string, ServiceInfo>>;
  readonly parameters: ReadonlySignal<ReadonlyMap<string, ParameterValue>>;
  /** Parameters with floating-point numbers, even whole ones; setting such a parameter keeps its type. */
  readonly floatParameters: ReadonlySignal<ReadonlySet<string>>;
  readonly graph: ReadonlySignal<GraphInfo>;
  /** Delay of velocity commands [s]; 0: they arrive in time. */
  readonly driveDelay: ReadonlySignal<number>;
  /**
   * Messages of the server about itself, newest last; a message with an id replaces the earlier one with the same id.
   */
  readonly notices: ReadonlySignal<
    readonly { readonly level: "info" | "warning" | "error"; readonly text: string; readonly id?: string | undefined }[]
  >;
  /** ROS time now [ns]: from /clock where it is used, else wall time. */
  now(): bigint;

  /**
   * Decoded messages of a topic, whether or not it is there yet. A message that cannot be decoded goes to `onError`.
   * One subscription of the socket serves all subscribers of a topic; when decoding lags, the oldest messages are
   * dropped unless `every`.
   */
  subscribe<M = RosMessage>(
    topic: string,
    onMessage: (received: Received<M>) => void,
    options?: { readonly every?: boolean; readonly onError?: (text: string) => void },
  ): Subscription;
  /**
   * Raw payloads: of the server's own channels (`trundle/…`), or of a topic that is only measured.
   * A `MessageFault` from `onPayload` becomes a notice.
   */
  subscribeRaw(topic: string, onPayload: (payload: DataView) => void): Subscription;
  /** Messages of one of the server's JSON channels; a message that cannot be read becomes a notice. */
  subscribeJson<T extends keyof Channels>(topic: T, onMessage: (message: Channels[T]) => void): Subscription;
  statistics(topic: string): TopicStatistics;

  /** Text of a type's definition with those of all types in it; rejects with a sentence if the type is unknown. */
  definition(type: string): Promise<string>;
  publish(topic: string, type: string, message: RosMessage): void;
  callService(name: string, request: RosMessage): Promise<RosMessage>;
  setParameter(name: string, value: ParameterValue | undefined): void;
  /** Bytes of a `package://`, `model://` or `file://` file. */
  fetchAsset(uri: string): Promise<ArrayBuffer>;
  /** Send a request to the page's server; rejects with a sentence. */
  request<N extends RequestName>(name: N, fields: Fields<N>): Promise<Answer<N>>;
  /** Open the connection for driving, so that the first command is not late. */
  prepareDriving(): void;
  /** Drive at velocities [m/s, rad/s] for a second, or until `release`. */
  drive(topic: string, linear: number, angular: number): void;
  release(): void;
  /** Type into a node's terminal, and set its size (columns, rows). */
  useTerminal(number: number, text: string, size?: readonly [number, number]): void;
  /** Show the selection to the other people. */
  present(selection: SharedSelection | null): void;
}
