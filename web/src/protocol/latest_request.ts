/** Requests that come faster than their answers: one at a time; of waiting requests only the newest is kept. */

export class LatestRequest {
  private waiting: (() => Promise<boolean>) | null = null;
  private isBusy = false;

  /** `onRefused`: the server refused one; those after it are dropped. */
  constructor(private readonly onRefused: () => void) {}

  send(ask: () => Promise<boolean>): void {
    this.waiting = ask;
    if (!this.isBusy) void this.drain();
  }

  /** Drop waiting requests. */
  clear(): void {
    this.waiting = null;
  }

  private async drain(): Promise<void> {
    this.isBusy = true;
    while (this.waiting !== null) {
      const ask = this.waiting;
      this.waiting = null;
      if (await ask()) continue;
      this.waiting = null;
      this.onRefused();
    }
    this.isBusy = false;
  }
}
