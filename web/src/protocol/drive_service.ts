/** The worker's side of driving: commands go out at 10 Hz while the page renews its lease, then one release. */

import { read } from "./check";
import { serverOperation } from "./generated/page_checks";
import { ReconnectingSocket, type Socket } from "./reconnecting_socket";

export const DRIVE_SUBPROTOCOL = "trundle.drive.v1";
const PERIOD = 100; // ms
/** Time from the page's newest request until the robot stops [ms]. */
export const LEASE = 1000;
/** Delay from which on commands are late [ms]. */
const LATE = 250;
/**
 * Largest number of unacknowledged commands, so that few old commands arrive before the release after a link stalls.
 */
const MAX_PENDING = 4;

interface DriveCommand {
  readonly topic: string;
  /** [m/s] */
  readonly linear: number;
  /** [rad/s] */
  readonly angular: number;
}

export type DriveRequest =
  | { readonly kind: "open"; readonly url: string }
  | { readonly kind: "drive"; readonly command: DriveCommand }
  | { readonly kind: "release" };

export type DriveReport =
  /** Delay of commands [s]; 0: they arrive in time. */
  { readonly kind: "delay"; readonly delay: number } | { readonly kind: "fault"; readonly text: string };

export class DriveService {
  readonly #socket: ReconnectingSocket;
  #command: DriveCommand | null = null;
  #renewedAt = 0;
  #timer: ReturnType<typeof setInterval> | undefined;
  #number = 0;
  /** Unacknowledged commands, oldest first. */
  #pending: { readonly number: number; readonly sentAt: number }[] = [];
  #roundTrip = 0;
  /** Time from which on commands could not be sent; null: the newest command was sent. */
  #unsentSince: number | null = null;
  #delay = 0;

  constructor(
    open: () => Socket,
    private readonly report: (report: DriveReport) => void,
  ) {
    const connect = (): Socket => {
      const socket = open();
      socket.onopen = () => this.#socket.established();
      return socket;
    };
    this.#socket = new ReconnectingSocket(
      connect,
      (data) => this.#receive(data),
      () => void (this.#pending = []),
    );
  }

  handle(request: Exclude<DriveRequest, { readonly kind: "open" }>): void {
    if (request.kind === "release") {
      this.#release();
      return;
    }
    const [old, command] = [this.#command, request.command];
    this.#command = command;
    this.#renewedAt = performance.now();
    if (old?.topic === command.topic && old.linear === command.linear && old.angular === command.angular) return;
    clearInterval(this.#timer);
    this.#timer = setInterval(() => this.#tick(), PERIOD);
    this.#send(command);
  }

  #tick(): void {
    if (this.#command === null || performance.now() - this.#renewedAt >= LEASE) this.#release();
    else this.#send(this.#command);
  }

  #send(command: DriveCommand): void {
    const now = performance.now();
    const lease = (this.#renewedAt + LEASE - now) / 1000;
    const number = this.#number;
    if (this.#pending.length < MAX_PENDING && this.#socket.send({ op: "trundle/drive", ...command, lease, number })) {
      this.#number += 1;
      this.#pending.push({ number, sentAt: now });
      this.#unsentSince = null;
    } else this.#unsentSince ??= now;
    this.#reportDelay();
  }

  #release(): void {
    clearInterval(this.#timer);
    if (this.#command !== null) this.#socket.send({ op: "trundle/release", topic: this.#command.topic });
    this.#command = this.#unsentSince = null;
    this.#roundTrip = 0;
    this.#reportDelay();
  }

  #receive(data: string | ArrayBuffer): void {
    if (typeof data !== "string") return; // the subprotocol has only text frames
    const frame = read(data, "a message", serverOperation);
    if (frame.op === "status") this.report({ kind: "fault", text: frame.message });
    if (frame.op !== "trundle/driven") return;
    for (let first = this.#pending[0]; first !== undefined && first.number <= frame.number; first = this.#pending[0]) {
      this.#roundTrip = performance.now() - first.sentAt;
      this.#pending.shift();
    }
    this.#reportDelay();
  }

  #reportDelay(): void {
    const now = performance.now();
    const since = Math.min(this.#pending[0]?.sentAt ?? now, this.#unsentSince ?? now);
    const longest = this.#command === null ? 0 : Math.max(this.#roundTrip, now - since);
    const delay = longest > LATE ? Math.round(longest / 100) / 10 : 0;
    if (delay === this.#delay) return;
    this.#delay = delay;
    this.report({ kind: "delay", delay });
  }
}
