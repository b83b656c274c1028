/** WebSocket that is opened again when it is lost. */

import { signal } from "@preact/signals";

import type { ConnectionState } from "./connection";
import type { ClientFrame } from "./wire";

/** Seconds until the next attempt, after each one that failed; the last of them from then on. */
const DELAYS = [1, 1, 2, 3, 5];

/** Part of WebSocket that is used. */
export type Socket = Pick<WebSocket, "send" | "close" | "onopen" | "onmessage" | "onclose">;

export class ReconnectingSocket {
  readonly state = signal<ConnectionState>({ kind: "connecting" });
  #socket: Socket | null = null;
  #failures = 0;

  constructor(
    private readonly open: () => Socket,
    private readonly onFrame: (data: string | ArrayBuffer) => void,
    private readonly onLost: () => void,
  ) {
    this.#connect();
  }

  /** Send a frame; false: the server has not greeted yet, or is lost. */
  send(frame: ClientFrame): boolean {
    if (this.#socket === null || this.state.peek().kind !== "connected") return false;
    this.#socket.send(frame instanceof ArrayBuffer ? frame : JSON.stringify(frame));
    return true;
  }

  /** The server has greeted: the connection is established. */
  established(): void {
    this.#failures = 0;
    this.state.value = { kind: "connected" };
  }

  #connect(): void {
    const socket = this.open();
    this.#socket = socket;
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => this.onFrame(event.data);
    socket.onclose = () => this.#lost();
  }

  #lost(): void {
    this.#socket = null;
    const delay = DELAYS[Math.min(this.#failures, DELAYS.length - 1)] ?? 1;
    this.#failures += 1;
    this.#wait(delay);
    this.onLost();
  }

  /** Count down the seconds in the state, which stays at "lost, 0 s" during the attempt. */
  #wait(seconds: number): void {
    this.state.value = { kind: "lost", retryInSeconds: seconds };
    if (seconds === 0) this.#connect();
    else setTimeout(() => this.#wait(seconds - 1), 1000);
  }
}
