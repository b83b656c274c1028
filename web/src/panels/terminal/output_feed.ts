/** Output of a terminal for the screen: in order, each byte once, with a bounded backlog. */

const MAX_WAITING = 1024 * 1024;

/** Screen that draws the output. */
export interface Screen {
  /** Draw bytes; calls `done` when they are drawn. */
  write(data: Uint8Array, done: () => void): void;
  /** Empty the screen and its scrollback. */
  reset(): void;
}

export class OutputFeed {
  /** Offset of the next expected byte in all output; null: unknown, so the next output replaces the screen. */
  private next: number | null = null;
  private waiting: Uint8Array[] = [];
  private waitingBytes = 0;
  private isWriting = false;
  private isStale = false;

  constructor(private readonly screen: Screen) {}

  /** Let the next output replace the screen, since it comes from another server. */
  restart(): void {
    this.next = null;
  }

  /** Add output; `first` is the offset of its first byte in all output so far. */
  receive(first: number, data: Uint8Array): void {
    const known = this.next === null ? -1 : this.next - first;
    if (known < 0 || known > data.length) this.discard();
    const fresh = known < 0 || known > data.length ? data : data.subarray(known);
    this.next = first + data.length;
    this.waiting.push(fresh);
    this.waitingBytes += fresh.length;
    while (this.waitingBytes > MAX_WAITING && this.waiting.length > 1) {
      this.waitingBytes -= this.waiting.shift()?.length ?? 0;
      this.isStale = true;
    }
    this.write();
  }

  private discard(): void {
    this.waiting = [];
    this.waitingBytes = 0;
    this.isStale = true;
  }

  private write(): void {
    if (this.isWriting || this.waitingBytes === 0) return;
    if (this.isStale) this.screen.reset();
    this.isStale = false;
    const data = joined(this.waiting, this.waitingBytes);
    this.waiting = [];
    this.waitingBytes = 0;
    this.isWriting = true;
    this.screen.write(data, () => {
      this.isWriting = false;
      this.write();
    });
  }
}

function joined(parts: readonly Uint8Array[], length: number): Uint8Array {
  const all = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}
