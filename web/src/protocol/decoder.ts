/** The page's side of decoding: a queue per topic before the worker. */

import type { DecodeRequest, DecodeResponse } from "./decode_service";
import type { RosMessage } from "./ros_types";

/** Limits of a queue that keeps every message. */
const MAX_FRAMES = 10_000;
const MAX_BYTES = 256 * 1024 * 1024;

/** Part of Worker that is used. */
export interface DecodePort {
  onmessage: ((event: MessageEvent<DecodeResponse>) => void) | null;
  postMessage(request: DecodeRequest, transfer: ArrayBuffer[]): void;
}

export interface Frame {
  /** Payload in a buffer of its own, which goes to the worker. */
  readonly payload: DataView<ArrayBuffer>;
  readonly time: bigint;
}

export interface Decoded {
  readonly time: bigint;
  readonly bytes: number;
  /** Message, or an error sentence. */
  readonly result: RosMessage | string;
}

/** A channel's queue: one batch is with the worker, the others wait. */
export class DecodeQueue {
  /** True: keep all waiting messages, not only the newest. */
  every = false;
  #waiting: Frame[] = [];
  #waitingBytes = 0;
  #sent: { readonly time: bigint; readonly bytes: number }[] = [];

  constructor(
    private readonly channel: number,
    private readonly port: DecodePort,
    private readonly onDecoded: (decoded: Decoded) => void,
    private readonly onDropped: () => void,
  ) {}

  push(frame: Frame): void {
    this.#waiting.push(frame);
    this.#waitingBytes += frame.payload.byteLength;
    const maxFrames = this.every ? MAX_FRAMES : 1;
    while (this.#waiting.length > 1 && (this.#waiting.length > maxFrames || this.#waitingBytes > MAX_BYTES)) {
      this.#waitingBytes -= this.#waiting.shift()?.payload.byteLength ?? 0;
      this.onDropped();
    }
    this.#send();
  }

  receive(results: readonly (RosMessage | string)[]): void {
    const sent = this.#sent;
    this.#sent = [];
    this.#send();
    results.forEach((result, i) => {
      const { time, bytes } = sent[i] ?? { time: 0n, bytes: 0 };
      this.onDecoded({ time, bytes, result });
    });
  }

  #send(): void {
    if (this.#sent.length > 0 || this.#waiting.length === 0) return;
    const payloads = this.#waiting.map((frame) => frame.payload);
    this.#sent = this.#waiting.map(({ time, payload }) => ({ time, bytes: payload.byteLength }));
    this.#waiting = [];
    this.#waitingBytes = 0;
    const buffers = payloads.map((payload) => payload.buffer);
    this.port.postMessage({ kind: "decode", channel: this.channel, payloads }, buffers);
  }
}

export class Decoder {
  readonly #queues = new Map<number, DecodeQueue>();
  #next = 0;

  constructor(private readonly port: DecodePort) {
    port.onmessage = (event) => this.#queues.get(event.data.channel)?.receive(event.data.results);
  }

  /** Queue for messages of a type; returns it and a function that closes it. */
  open(
    name: string,
    definition: string,
    onDecoded: (decoded: Decoded) => void,
    onDropped: () => void,
  ): { readonly queue: DecodeQueue; readonly close: () => void } {
    const channel = this.#next++;
    const queue = new DecodeQueue(channel, this.port, onDecoded, onDropped);
    this.#queues.set(channel, queue);
    this.port.postMessage({ kind: "open", channel, name, definition }, []);
    const close = () => {
      this.#queues.delete(channel);
      this.port.postMessage({ kind: "close", channel }, []);
    };
    return { queue, close };
  }
}
