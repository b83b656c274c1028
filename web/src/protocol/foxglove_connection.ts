/** The connection to the page's server. */

import { MessageFault, read, readPayload } from "./check";
import type {
  Answer,
  Connection,
  Fields,
  ParameterValue,
  Received,
  RequestName,
  Subscription,
  TopicStatistics,
} from "./connection";
import { Calls } from "./calls";
import { Decoder, type DecodePort } from "./decoder";
import { DriveLink, type DrivePort } from "./drive_link";
import { channels, serverOperation } from "./generated/page_checks";
import type { Channels, SharedSelection } from "./generated/page_messages";
import { MessageParts } from "./message_parts";
import { Notices } from "./notices";
import { Publications } from "./publications";
import { ReconnectingSocket, type Socket } from "./reconnecting_socket";
import type { RosMessage } from "./ros_types";
import { ServerClock } from "./server_clock";
import { Subscriptions } from "./subscriptions";
import { SystemState } from "./system_state";
import { readBinary, SUBPROTOCOLS, type ClientFrame } from "./wire";
import { WorkerSockets } from "./worker_sockets";

export class FoxgloveConnection implements Connection {
  readonly #socket: ReconnectingSocket;
  readonly #subscriptions: Subscriptions;
  readonly #calls: Calls;
  readonly #publications: Publications;
  readonly #system: SystemState;
  readonly #drive: DriveLink;
  readonly #notices = new Notices();
  readonly #clock = new ServerClock();
  readonly #parts = new MessageParts();
  /** Last time from the server [ns]; null: the wall clock is used. */
  #time: bigint | null = null;

  constructor(
    open: () => Socket,
    decodePort: DecodePort,
    drive: { readonly url: string; readonly open: () => DrivePort },
  ) {
    const send = (frame: ClientFrame): boolean => this.#socket.send(frame);
    this.#subscriptions = new Subscriptions(send, new Decoder(decodePort));
    this.#calls = new Calls(send);
    this.#publications = new Publications(send, (type) => this.definition(type));
    this.#system = new SystemState(send);
    this.#drive = new DriveLink(drive.url, drive.open, (text) => this.#notices.add("error", text, text));
    this.subscribeJson("trundle/drops", (drops) => this.#subscriptions.setServerDrops(drops));
    this.#socket = new ReconnectingSocket(
      open,
      (data) => this.#receive(data),
      () => this.#lost(),
    );
  }

  get state(): Connection["state"] {
    return this.#socket.state;
  }
  get lag(): Connection["lag"] {
    return this.#clock.lag;
  }
  get topics(): Connection["topics"] {
    return this.#subscriptions.topics;
  }
  get services(): Connection["services"] {
    return this.#calls.services;
  }
  get parameters(): Connection["parameters"] {
    return this.#system.parameters;
  }
  get floatParameters(): Connection["floatParameters"] {
    return this.#system.floatParameters;
  }
  get graph(): Connection["graph"] {
    return this.#system.graph;
  }
  get driveDelay(): Connection["driveDelay"] {
    return this.#drive.delay;
  }
  get notices(): Connection["notices"] {
    return this.#notices.list;
  }

  now(): bigint {
    return this.#time ?? BigInt(Date.now()) * 1_000_000n;
  }

  subscribe<M = RosMessage>(
    topic: string,
    onMessage: (received: Received<M>) => void,
    options: { readonly every?: boolean; readonly onError?: (text: string) => void } = {},
  ): Subscription {
    return this.#subscriptions.subscribe(topic, {
      onMessage: onMessage as (received: Received<unknown>) => void, // M is the caller's assertion of the topic's type
      onError: options.onError,
      every: options.every ?? false,
    });
  }

  subscribeRaw(topic: string, onPayload: (payload: DataView) => void): Subscription {
    return this.#subscriptions.subscribeRaw(topic, onPayload);
  }

  subscribeJson<T extends keyof Channels>(topic: T, onMessage: (message: Channels[T]) => void): Subscription {
    return this.subscribeRaw(topic, (payload) => onMessage(readPayload(payload, topic, channels[topic])));
  }

  statistics(topic: string): TopicStatistics {
    return this.#subscriptions.statistics(topic);
  }

  async definition(type: string): Promise<string> {
    const text = this.#subscriptions.definition(type);
    if (text !== null) return text;
    return (await this.#calls.request("definition", { type })).definition;
  }

  publish(topic: string, type: string, message: RosMessage): void {
    this.#publications.publish(topic, type, message).catch((error: unknown) => {
      this.#notices.add("error", `Nothing was published on ${topic}: ${(error as Error).message}`, `publish ${topic}`);
    });
  }

  callService(name: string, request: RosMessage): Promise<RosMessage> {
    return this.#calls.call(name, request);
  }

  setParameter(name: string, value: ParameterValue | undefined): void {
    this.#system.setParameter(name, value);
  }

  fetchAsset(uri: string): Promise<ArrayBuffer> {
    return this.#calls.fetchAsset(uri);
  }

  request<N extends RequestName>(name: N, fields: Fields<N>): Promise<Answer<N>> {
    return this.#calls.request(name, fields);
  }

  prepareDriving(): void {
    this.#drive.open();
  }

  drive(topic: string, linear: number, angular: number): void {
    this.#drive.drive(topic, linear, angular);
  }

  release(): void {
    this.#drive.release();
  }

  useTerminal(number: number, text: string, size?: readonly [number, number]): void {
    this.#socket.send({ op: "trundle/terminal", number, text, size: size ?? null });
  }

  present(selection: SharedSelection | null): void {
    this.#socket.send({ op: "trundle/presence", selection });
  }

  /** Handle a frame; a frame that cannot be read becomes a notice. */
  #receive(data: string | ArrayBuffer): void {
    try {
      const message = typeof data === "string" ? data : this.#parts.join(data);
      if (typeof message === "string") this.#receiveText(message);
      else if (message !== null) this.#receiveBinary(message);
    } catch (error) {
      if (!(error instanceof MessageFault)) throw error;
      this.#notices.add("error", error.message, error.message);
    }
  }

  #receiveText(data: string): void {
    const frame = read(data, "a message", serverOperation);
    switch (frame.op) {
      case "serverInfo":
        this.#greeted(frame.capabilities);
        break;
      case "status":
        this.#notices.add(frame.level, frame.message, frame.id);
        break;
      case "removeStatus":
        this.#notices.remove(frame.statusIds);
        break;
      case "advertise":
        this.#subscriptions.advertise(frame.channels);
        break;
      case "unadvertise":
        this.#subscriptions.unadvertise(frame.channelIds);
        break;
      case "advertiseServices":
        this.#calls.advertise(frame.services);
        break;
      case "unadvertiseServices":
        this.#calls.unadvertise(frame.serviceIds);
        break;
      case "parameterValues":
        this.#system.receiveParameters(frame.parameters);
        break;
      case "connectionGraphUpdate":
        this.#system.graphChanged(frame);
        break;
      case "serviceCallFailure":
        this.#calls.callFailed(frame);
        break;
      case "trundle/response":
        this.#calls.requestAnswered(frame);
        break;
    }
  }

  #receiveBinary(data: ArrayBuffer): void {
    const frame = readBinary(data);
    if (frame.op === "message") {
      // messages in between are newer than the server's time, which comes at 20 Hz
      if (this.#time !== null && frame.time > this.#time) this.#time = frame.time;
      this.#subscriptions.receive(frame, this.#clock.sentAt(frame.serverTime));
    } else if (frame.op === "mark") {
      this.#clock.sentAt(frame.serverTime);
      this.#socket.send({ op: "trundle/echo", mark: frame.mark });
    } else if (frame.op === "time") this.#time = frame.time;
    else if (frame.op === "serviceResponse") this.#calls.callAnswered(frame);
    else this.#calls.receiveAsset(frame);
  }

  #lost(): void {
    this.#clock.stop();
    this.#parts.clear();
    this.#calls.lost();
  }

  /** Start with a server that has just greeted. */
  #greeted(capabilities: readonly string[]): void {
    this.#time = null;
    this.#clock.start();
    this.#notices.clear();
    this.#subscriptions.restart();
    this.#calls.restart();
    this.#publications.restart();
    this.#socket.established(); // last: listeners subscribe at once, to this server's channels
    this.#system.restart(capabilities);
  }
}

/** Connect to the server of the page at an address. */
export function connect(address: string): FoxgloveConnection {
  const url = new URL(address);
  url.protocol = url.protocol.replace("http", "ws");
  url.hash = "";
  const sockets = new WorkerSockets(new Worker(new URL("./socket_worker.ts", import.meta.url), { type: "module" }));
  const decoder = new Worker(new URL("./decode_worker.ts", import.meta.url), { type: "module" });
  const openDrive = (): Worker => new Worker(new URL("./drive_worker.ts", import.meta.url), { type: "module" });
  return new FoxgloveConnection(() => sockets.open(url.href, SUBPROTOCOLS), decoder, {
    url: url.href,
    open: openDrive,
  });
}
