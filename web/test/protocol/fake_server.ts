/** The server's end of a connection, and a decoder with a MessageChannel in place of a worker. */

import { DecodeService, type DecodeRequest } from "../../src/protocol/decode_service";
import type { DrivePort } from "../../src/protocol/drive_link";
import type { DriveReport, DriveRequest } from "../../src/protocol/drive_service";
import { FoxgloveConnection } from "../../src/protocol/foxglove_connection";
import type { ServerOperation } from "../../src/protocol/generated/page_messages";
import type { Socket } from "../../src/protocol/reconnecting_socket";

export class FakeSocket implements Socket {
  onopen: WebSocket["onopen"] = null;
  onmessage: WebSocket["onmessage"] = null;
  onclose: WebSocket["onclose"] = null;
  readonly sent: (Record<string, unknown> | ArrayBuffer)[] = [];

  send(frame: string | ArrayBufferLike | Blob | ArrayBufferView): void {
    this.sent.push(typeof frame === "string" ? (JSON.parse(frame) as Record<string, unknown>) : (frame as ArrayBuffer));
  }

  close(): void {
    this.onclose?.call(null as never, new Event("close") as CloseEvent);
  }

  text(frame: ServerOperation): void {
    this.raw(JSON.stringify(frame));
  }

  /** The answer to a request. */
  answer(id: number, fields: object = {}): void {
    this.raw(JSON.stringify({ op: "trundle/response", id, ok: true, ...fields }));
  }

  /** Text as it comes. */
  raw(text: string): void {
    this.#receive(text);
  }

  binary(...parts: readonly (readonly number[] | Uint8Array)[]): void {
    this.#receive(new Uint8Array(parts.flatMap((part) => [...part])).buffer);
  }

  /** Message Data. */
  message(subscription: number, payload: Uint8Array | readonly number[], time = 0n, serverTime = 0): void {
    this.binary(messageBytes(subscription, payload, time, serverTime));
  }

  /** Message Data in parts, the last of them with `last`. */
  part(stream: number, payload: Uint8Array, last: boolean, text = false): void {
    this.binary([0x80], u32(stream), [Number(last), Number(text)], payload);
  }

  /** A mark, sent at the server's time [ms]. */
  mark(number: number, serverTime: number): void {
    this.binary([0x82], u32(number), u64(BigInt(Math.round(serverTime * 1e6))));
  }

  greet(capabilities = ["parameters", "parametersSubscribe", "connectionGraph"]): void {
    const session = { supportedEncodings: ["ros1"], metadata: {}, sessionId: "1" };
    this.text({ op: "serverInfo", name: "test", capabilities, ...session });
  }

  advertise(id: number, topic: string, schemaName: string, schema: string, encoding = "ros1"): void {
    this.text({ op: "advertise", channels: [{ id, topic, encoding, schemaName, schema }] });
  }

  /** Number of the last subscription to a channel. */
  subscription(channelId: number): number {
    for (const frame of this.sent.toReversed()) {
      if (frame instanceof ArrayBuffer || frame["op"] !== "subscribe") continue;
      const all = frame["subscriptions"] as { id: number; channelId: number }[];
      const subscription = all.find((one) => one.channelId === channelId);
      if (subscription !== undefined) return subscription.id;
    }
    throw new Error(`channel ${String(channelId)} has no subscription`);
  }

  ops(op: string): Record<string, unknown>[] {
    return this.sent.filter((frame) => !(frame instanceof ArrayBuffer) && frame["op"] === op) as Record<
      string,
      unknown
    >[];
  }

  #receive(data: string | ArrayBuffer): void {
    this.onmessage?.call(null as never, new MessageEvent("message", { data }));
  }
}

export class FakeServer {
  readonly sockets: FakeSocket[] = [];
  readonly connection: FoxgloveConnection;
  /** Requests to the worker that drives. */
  readonly driveRequests: DriveRequest[] = [];
  readonly drivePort: DrivePort = { onmessage: null, postMessage: (request) => void this.driveRequests.push(request) };
  readonly #ports: MessagePort[];

  constructor() {
    const { port1, port2 } = new MessageChannel();
    this.#ports = [port1, port2];
    const service = new DecodeService((response, transfer) => port2.postMessage(response, transfer));
    port2.onmessage = (event: MessageEvent<DecodeRequest>) => service.handle(event.data);
    this.connection = new FoxgloveConnection(
      () => {
        const socket = new FakeSocket();
        this.sockets.push(socket);
        return socket;
      },
      port1,
      { url: "ws://here/", open: () => this.drivePort },
    );
  }

  get socket(): FakeSocket {
    const last = this.sockets.at(-1);
    if (last === undefined) throw new Error("nobody connected");
    return last;
  }

  reportDriving(report: DriveReport): void {
    this.drivePort.onmessage?.(new MessageEvent("message", { data: report }));
  }

  close(): void {
    for (const port of this.#ports) port.close();
  }
}

/** Frame of a message that the server had at its time [ms]. */
export function messageBytes(
  subscription: number,
  payload: Uint8Array | readonly number[],
  time = 0n,
  serverTime = 0,
): Uint8Array {
  const stamp = u64(BigInt(Math.round(serverTime * 1e6)));
  return new Uint8Array([0x81, ...u32(subscription), ...u64(time), ...stamp, ...payload]);
}

export function u32(value: number): Uint8Array {
  return new Uint8Array(new Uint32Array([value]).buffer);
}

export function u64(value: bigint): Uint8Array {
  return new Uint8Array(new BigUint64Array([value]).buffer);
}
