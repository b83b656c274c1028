import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";

import { ServerClock } from "../../src/protocol/server_clock";

/** Difference of the server's clock to the page's [ms]. */
const AHEAD = 1e12;

let clock: ServerClock;
beforeEach(() => {
  vi.useFakeTimers();
  clock = new ServerClock();
  clock.start();
});
afterEach(() => {
  clock.stop();
  vi.useRealTimers();
});

/** Receive what was sent `delay` ms before, every 50 ms. */
function receive(seconds: number, delay: (at: number) => number): void {
  for (let at = 0; at < seconds * 1000; at += 50) {
    vi.advanceTimersByTime(50);
    clock.sentAt(AHEAD + performance.now() - delay(at));
  }
}

test("a message's time is the server's, by the page's clock", () => {
  clock.sentAt(AHEAD + performance.now());
  vi.advanceTimersByTime(400);

  expect(clock.sentAt(AHEAD + performance.now() - 300)).toBeCloseTo(performance.now() - 300, 2);
});

describe("lag", () => {
  test("a page that is up to date has none", () => {
    receive(5, () => 20);
    expect(clock.lag.value).toBeNull();
  });

  test("late messages are a lag from when they began on, which ends by itself", () => {
    receive(2, () => 20);
    const began = Date.now();
    receive(2, () => 1220);
    expect(clock.lag.value?.seconds).toBeCloseTo(1.2, 1);
    expect(Math.abs((clock.lag.value?.since ?? 0) - began)).toBeLessThan(1500);

    receive(1, () => 100);
    expect(clock.lag.value).toBeNull();
  });

  test("messages that came while the page was busy are no lag if the newest is fresh", () => {
    receive(1, () => 0);
    for (let i = 0; i < 10; i++) {
      vi.advanceTimersByTime(450);
      for (let age = 450; age >= 0; age -= 50) clock.sentAt(AHEAD + performance.now() - age);
      expect(clock.lag.value).toBeNull();
    }
  });

  test("a silent connection is late", () => {
    receive(1, () => 0);
    vi.advanceTimersByTime(4000);
    expect(clock.lag.value?.seconds).toBeGreaterThan(3.5);
  });

  test("a lost connection has none", () => {
    receive(1, () => 0);
    vi.advanceTimersByTime(4000);
    clock.stop();
    expect(clock.lag.value).toBeNull();
  });
});
