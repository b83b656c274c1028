/** The page's side of driving; a worker sends the commands. */

import { signal } from "@preact/signals";

import type { DriveReport, DriveRequest } from "./drive_service";

/** Part of Worker that is used. */
export interface DrivePort {
  onmessage: ((event: MessageEvent<DriveReport>) => void) | null;
  postMessage(request: DriveRequest): void;
}

export class DriveLink {
  readonly delay = signal(0);
  #port: DrivePort | null = null;

  constructor(
    private readonly url: string,
    private readonly openPort: () => DrivePort,
    private readonly onFault: (text: string) => void,
  ) {}

  /** Open the connection, so that the first command is not late. */
  open(): DrivePort {
    if (this.#port !== null) return this.#port;
    const port = this.openPort();
    port.onmessage = ({ data: report }) => {
      if (report.kind === "delay") this.delay.value = report.delay;
      else this.onFault(report.text);
    };
    port.postMessage({ kind: "open", url: this.url });
    this.#port = port;
    return port;
  }

  drive(topic: string, linear: number, angular: number): void {
    this.open().postMessage({ kind: "drive", command: { topic, linear, angular } });
  }

  release(): void {
    this.#port?.postMessage({ kind: "release" });
  }
}
