/** Topics of the server and the page's subscriptions to them. */

import { signal } from "@preact/signals";

import type { Received, Subscription, TopicInfo, TopicStatistics } from "./connection";
import type { Decoded, DecodeQueue, Decoder } from "./decoder";
import type { ChannelOffer } from "./generated/page_messages";
import type { RosMessage } from "./ros_types";
import { ArrivalStatistics } from "./topic_statistics";
import type { Send, ServerBinary } from "./wire";

interface Subscriber {
  readonly onMessage: (received: Received<RosMessage>) => void;
  readonly onError: ((text: string) => void) | undefined;
  readonly every: boolean;
}

/** A topic that was ever subscribed to. */
interface Topic {
  readonly name: string;
  readonly subscribers: Set<Subscriber>;
  readonly raw: Set<(payload: DataView) => void>;
  readonly statistics: ArrivalStatistics;
  /** Ids of subscriptions at the server; only the last is active, but messages of earlier ones may still arrive. */
  readonly ids: number[];
  decoding: { readonly queue: DecodeQueue; readonly close: () => void } | null;
}

export class Subscriptions {
  readonly topics = signal<ReadonlyMap<string, TopicInfo>>(new Map());
  readonly #channels = new Map<number, ChannelOffer>();
  readonly #topics = new Map<string, Topic>();
  readonly #bySubscription = new Map<number, Topic>();
  #nextSubscription = 0;

  constructor(
    private readonly send: Send,
    private readonly decoder: Decoder,
  ) {}

  /** Begin again with a server that has advertised nothing yet. */
  restart(): void {
    for (const topic of this.#topics.values()) {
      this.#detach(topic);
      topic.statistics.keepServerDrops();
    }
    this.#channels.clear();
    this.#publishTopics();
  }

  advertise(channels: readonly ChannelOffer[]): void {
    for (const channel of channels) this.#channels.set(channel.id, channel);
    this.#publishTopics();
    for (const channel of channels) {
      const topic = this.#topics.get(channel.topic);
      if (topic !== undefined && topic.ids.length === 0 && isSubscribed(topic)) this.#attach(topic, channel);
    }
  }

  unadvertise(ids: readonly number[]): void {
    for (const id of ids) {
      const channel = this.#channels.get(id);
      this.#channels.delete(id);
      const topic = channel === undefined ? undefined : this.#topics.get(channel.topic);
      if (topic !== undefined) this.#detach(topic);
    }
    this.#publishTopics();
  }

  subscribe(name: string, subscriber: Subscriber): Subscription {
    const topic = this.#topic(name);
    topic.subscribers.add(subscriber);
    this.#attachAgain(topic);
    return {
      close: () => {
        if (topic.subscribers.delete(subscriber)) this.#left(topic);
      },
    };
  }

  subscribeRaw(name: string, onPayload: (payload: DataView) => void): Subscription {
    const topic = this.#topic(name);
    topic.raw.add(onPayload);
    // Measuring needs no latched messages.
    if (topic.ids.length === 0 || this.#channel(name)?.encoding !== "ros1") this.#attachAgain(topic);
    return {
      close: () => {
        if (topic.raw.delete(onPayload)) this.#left(topic);
      },
    };
  }

  /** Deliver a message; `sentAt` is when the server had it, by `performance.now()` [ms]. */
  receive(frame: Extract<ServerBinary, { op: "message" }>, sentAt: number): void {
    const topic = this.#bySubscription.get(frame.subscription);
    if (topic === undefined) return;
    const payload = frame.payload as DataView<ArrayBuffer>;
    topic.statistics.add(sentAt, payload.byteLength);
    for (const onPayload of topic.raw) onPayload(payload);
    topic.decoding?.queue.push({ payload, time: frame.time });
  }

  statistics(name: string): TopicStatistics {
    return (this.#topics.get(name)?.statistics ?? new ArrivalStatistics()).at(performance.now());
  }

  /** Text of a type's definition, if a topic has it. */
  definition(type: string): string | null {
    for (const channel of this.#channels.values()) if (channel.schemaName === type) return channel.schema;
    return null;
  }

  /** Set the numbers of messages that the server dropped since the connection began. */
  setServerDrops(drops: Readonly<Record<string, number>>): void {
    for (const [name, count] of Object.entries(drops)) {
      const topic = this.#topics.get(name);
      if (topic !== undefined) topic.statistics.serverDropped = count;
    }
  }

  #topic(name: string): Topic {
    const known = this.#topics.get(name);
    if (known !== undefined) return known;
    const topic: Topic = {
      name,
      subscribers: new Set(),
      raw: new Set(),
      statistics: new ArrivalStatistics(),
      ids: [],
      decoding: null,
    };
    this.#topics.set(name, topic);
    return topic;
  }

  /** Subscribe again, so that a later subscriber gets latched messages. */
  #attachAgain(topic: Topic): void {
    const channel = this.#channel(topic.name);
    if (channel === undefined) return;
    this.#unsubscribe(topic);
    this.#attach(topic, channel);
  }

  #left(topic: Topic): void {
    if (!isSubscribed(topic)) {
      this.#unsubscribe(topic);
      this.#detach(topic);
    } else if (topic.decoding !== null) topic.decoding.queue.every = wantsEvery(topic);
  }

  #channel(name: string): ChannelOffer | undefined {
    for (const channel of this.#channels.values()) if (channel.topic === name) return channel;
    return undefined;
  }

  #attach(topic: Topic, channel: ChannelOffer): void {
    const id = this.#nextSubscription++;
    topic.ids.push(id);
    this.#bySubscription.set(id, topic);
    if (topic.subscribers.size > 0) this.#decode(topic, channel);
    this.send({ op: "subscribe", subscriptions: [{ id, channelId: channel.id }] });
  }

  #decode(topic: Topic, channel: ChannelOffer): void {
    if (channel.encoding !== "ros1") {
      const text = `messages of ${topic.name} have the encoding ${channel.encoding}, which the page does not read`;
      for (const subscriber of topic.subscribers) subscriber.onError?.(text);
      return;
    }
    topic.decoding ??= this.decoder.open(
      channel.schemaName,
      channel.schema,
      (decoded) => deliver(topic, channel.schemaName, decoded),
      () => (topic.statistics.dropped += 1),
    );
    topic.decoding.queue.every = wantsEvery(topic);
  }

  #unsubscribe(topic: Topic): void {
    const last = topic.ids.at(-1);
    if (last !== undefined) this.send({ op: "unsubscribe", subscriptionIds: [last] });
  }

  /** Forget the subscriptions at the server, which ended. */
  #detach(topic: Topic): void {
    for (const id of topic.ids) this.#bySubscription.delete(id);
    topic.ids.length = 0;
    topic.decoding?.close();
    topic.decoding = null;
  }

  #publishTopics(): void {
    const topics = new Map<string, TopicInfo>();
    for (const { topic, schemaName, encoding } of this.#channels.values()) {
      if (!topic.startsWith("trundle/")) topics.set(topic, { name: topic, type: schemaName, encoding });
    }
    this.topics.value = topics;
  }
}

function isSubscribed(topic: Topic): boolean {
  return topic.subscribers.size + topic.raw.size > 0;
}

function wantsEvery(topic: Topic): boolean {
  return [...topic.subscribers].some((subscriber) => subscriber.every);
}

function deliver(topic: Topic, type: string, { time, bytes, result }: Decoded): void {
  for (const subscriber of topic.subscribers) {
    try {
      if (typeof result === "string") subscriber.onError?.(result);
      else subscriber.onMessage({ topic: topic.name, type, message: result, time, bytes });
    } catch (error) {
      console.error(error); // one subscriber's error does not affect the others
    }
  }
}
