/** Parameters and the graph of the system, which the server sends while subscribed. */

import { batch, signal } from "@preact/signals";

import type { GraphInfo, ParameterValue } from "./connection";
import type { ConnectionGraphUpdate, Parameter } from "./generated/page_messages";
import type { ClientFrame, Send } from "./wire";

const NO_GRAPH: GraphInfo = { types: new Map(), publishers: new Map(), subscribers: new Map(), services: new Map() };

export class SystemState {
  readonly parameters = signal<ReadonlyMap<string, ParameterValue>>(new Map(), {
    watched: () => this.#watchParameters(),
    unwatched: () => this.#unwatchParameters(),
  });
  /** Parameters that are floating-point, also where their numbers are whole. */
  readonly floatParameters = signal<ReadonlySet<string>>(new Set());
  readonly graph = signal<GraphInfo>(NO_GRAPH, {
    watched: () => this.#watchGraph(),
    unwatched: () => this.#unwatchGraph(),
  });
  #parametersWatched = false;
  #graphWatched = false;
  #capabilities: readonly string[] = [];

  constructor(private readonly send: Send) {}

  /** Begin again with a new server of these capabilities. */
  restart(capabilities: readonly string[]): void {
    this.#capabilities = capabilities;
    this.parameters.value = new Map();
    this.floatParameters.value = new Set();
    this.graph.value = NO_GRAPH;
    if (this.#parametersWatched) this.#watchParameters();
    if (this.#graphWatched) this.#watchGraph();
  }

  setParameter(name: string, value: ParameterValue | undefined): void {
    const type = Array.isArray(value) ? ("float64_array" as const) : ("float64" as const);
    const float = this.floatParameters.peek().has(name) ? { type } : {};
    this.send({
      op: "setParameters",
      parameters: [value === undefined ? { name } : { name, value, ...float }],
      id: "set",
    });
  }

  receiveParameters(values: readonly Parameter[]): void {
    const parameters = new Map(this.parameters.peek());
    const floats = new Set(this.floatParameters.peek());
    for (const { name, value, type } of values) {
      if (value === undefined) parameters.delete(name);
      else parameters.set(name, value);
      if (value !== undefined && type?.startsWith("float64") === true) floats.add(name);
      else floats.delete(name);
    }
    batch(() => {
      this.parameters.value = parameters;
      this.floatParameters.value = floats;
    });
  }

  graphChanged(update: ConnectionGraphUpdate): void {
    const { types, publishers, subscribers, services } = this.graph.peek();
    const next = {
      types: new Map(types),
      publishers: new Map(publishers),
      subscribers: new Map(subscribers),
      services: new Map(services),
    };
    for (const name of update.removedTopics) {
      next.publishers.delete(name);
      next.subscribers.delete(name);
      next.types.delete(name);
    }
    for (const name of update.removedServices) next.services.delete(name);
    for (const { name, publisherIds } of update.publishedTopics) next.publishers.set(name, publisherIds);
    for (const { name, subscriberIds, type = "*" } of update.subscribedTopics) {
      next.subscribers.set(name, subscriberIds);
      if (type !== "*" && subscriberIds.length > 0) next.types.set(name, type);
      else next.types.delete(name);
    }
    for (const { name, providerIds } of update.advertisedServices) next.services.set(name, providerIds);
    this.graph.value = next;
  }

  #watchParameters(): void {
    this.#parametersWatched = true;
    this.#sendFor("parametersSubscribe", { op: "subscribeParameterUpdates", parameterNames: [] });
    this.#sendFor("parameters", { op: "getParameters", parameterNames: [], id: "all" });
  }

  #unwatchParameters(): void {
    this.#parametersWatched = false;
    this.#sendFor("parametersSubscribe", { op: "unsubscribeParameterUpdates", parameterNames: [] });
  }

  #watchGraph(): void {
    this.#graphWatched = true;
    this.#sendFor("connectionGraph", { op: "subscribeConnectionGraph" });
  }

  #unwatchGraph(): void {
    this.#graphWatched = false;
    this.#sendFor("connectionGraph", { op: "unsubscribeConnectionGraph" });
  }

  #sendFor(capability: string, frame: ClientFrame): void {
    if (this.#capabilities.includes(capability)) this.send(frame);
  }
}
