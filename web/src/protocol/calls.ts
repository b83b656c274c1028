/** Calls to the server that are answered later: services, assets and requests. */

import { signal } from "@preact/signals";

import { checked } from "./check";
import type { Answer, Fields, RequestName, ServiceInfo } from "./connection";
import { answers } from "./generated/page_checks";
import type { Response, ServiceCallFailure, ServiceOffer } from "./generated/page_messages";
import { readMessage } from "./reader";
import type { RosMessage } from "./ros_types";
import { parseSchema, type Schema } from "./schema";
import { callFrame, type Send, type ServerBinary } from "./wire";
import { writeMessage } from "./writer";

/** Pending answers, by number. */
class Pending<T> {
  readonly #waiting = new Map<number, { resolve: (value: T) => void; reject: (reason: Error) => void }>();
  #next = 0;

  /** Send with a number and wait for the answer. */
  ask(send: (id: number) => boolean): Promise<T> {
    const id = this.#next++;
    return new Promise<T>((resolve, reject) => {
      if (send(id)) this.#waiting.set(id, { resolve, reject });
      else reject(new Error("the page is not connected"));
    });
  }

  resolve(id: number, value: T): void {
    this.#waiting.get(id)?.resolve(value);
    this.#waiting.delete(id);
  }

  reject(id: number, sentence: string): void {
    this.#waiting.get(id)?.reject(new Error(sentence));
    this.#waiting.delete(id);
  }

  rejectAll(sentence: string): void {
    for (const id of [...this.#waiting.keys()]) this.reject(id, sentence);
  }
}

export class Calls {
  readonly services = signal<ReadonlyMap<string, ServiceInfo>>(new Map());
  readonly #services = new Map<number, ServiceOffer>();
  readonly #calls = new Pending<DataView>();
  readonly #assets = new Pending<ArrayBuffer>();
  readonly #requests = new Pending<Response>();

  constructor(private readonly send: Send) {}

  /** Begin again with a server that has advertised nothing yet. */
  restart(): void {
    this.#services.clear();
    this.#publishServices();
  }

  /** Reject all pending calls, since the connection is lost. */
  lost(): void {
    for (const pending of [this.#calls, this.#assets, this.#requests]) {
      pending.rejectAll("the connection was lost before the answer came");
    }
  }

  advertise(services: readonly ServiceOffer[]): void {
    for (const service of services) this.#services.set(service.id, service);
    this.#publishServices();
  }

  unadvertise(ids: readonly number[]): void {
    for (const id of ids) this.#services.delete(id);
    this.#publishServices();
  }

  async call(name: string, request: RosMessage): Promise<RosMessage> {
    const service = [...this.#services.values()].find((one) => one.name === name);
    if (service === undefined) throw new Error(`there is no service ${name}`);
    const payload = writeMessage(requestSchema(service), request);
    const response = await this.#calls.ask((id) => this.send(callFrame(service.id, id, payload)));
    return readMessage(responseSchema(service), response);
  }

  fetchAsset(uri: string): Promise<ArrayBuffer> {
    return this.#assets.ask((requestId) => this.send({ op: "fetchAsset", uri, requestId }));
  }

  async request<N extends RequestName>(name: N, fields: Fields<N>): Promise<Answer<N>> {
    const ask = (id: number): boolean => this.send({ ...fields, op: "trundle/request", id, request: name });
    return checked(await this.#requests.ask(ask), `the answer to '${name}'`, answers[name]);
  }

  callAnswered(frame: Extract<ServerBinary, { op: "serviceResponse" }>): void {
    this.#calls.resolve(frame.call, frame.payload);
  }

  callFailed(frame: ServiceCallFailure): void {
    this.#calls.reject(frame.callId, frame.message);
  }

  receiveAsset(frame: Extract<ServerBinary, { op: "asset" }>): void {
    if (frame.error === null) this.#assets.resolve(frame.request, frame.data);
    else this.#assets.reject(frame.request, frame.error);
  }

  requestAnswered(response: Response): void {
    const { id, ok, error = "the server does not say why" } = response;
    if (ok) this.#requests.resolve(Number(id), response);
    else this.#requests.reject(Number(id), error);
  }

  #publishServices(): void {
    const services = new Map<string, ServiceInfo>();
    for (const service of this.#services.values()) {
      const { name, type } = service;
      services.set(name, { name, type, request: service.request.schema, response: service.response.schema });
    }
    this.services.value = services;
  }
}

function requestSchema({ request }: ServiceOffer): Schema {
  return parseSchema(request.schemaName, request.schema);
}

function responseSchema({ response }: ServiceOffer): Schema {
  return parseSchema(response.schemaName, response.schema);
}
