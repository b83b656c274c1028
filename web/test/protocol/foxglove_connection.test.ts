import { effect } from "@preact/signals";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";

import type { Received } from "../../src/protocol/connection";
import { FakeServer, messageBytes } from "./fake_server";

let server: FakeServer;
beforeEach(() => {
  server = new FakeServer();
});
afterEach(() => {
  server.close();
  vi.useRealTimers();
});

function greeted(): FakeServer {
  server.socket.greet();
  return server;
}

/** Collects a topic's messages; `until` waits for a number of them. */
function collect(topic: string, options: { every?: boolean } = {}) {
  const received: Received<Record<string, unknown>>[] = [];
  const errors: string[] = [];
  const subscription = server.connection.subscribe<Record<string, unknown>>(topic, (one) => received.push(one), {
    ...options,
    onError: (text) => errors.push(text),
  });
  const until = (count: number) =>
    vi.waitFor(() => expect(received.length + errors.length).toBeGreaterThanOrEqual(count));
  return { received, errors, subscription, until };
}

describe("connecting", () => {
  test("is connected once the server has greeted, and reconnects with growing delays", () => {
    vi.useFakeTimers();
    const { connection, sockets } = server;
    expect(connection.state.value).toEqual({ kind: "connecting" });
    server.socket.greet();
    expect(connection.state.value).toEqual({ kind: "connected" });

    const waits: number[] = [];
    for (let i = 0; i < 6; i++) {
      server.socket.close();
      const state = connection.state.value;
      waits.push(state.kind === "lost" ? state.retryInSeconds : -1);
      vi.advanceTimersByTime(1000 * (waits.at(-1) ?? 0));
      expect(sockets).toHaveLength(i + 2);
    }
    expect(waits).toEqual([1, 1, 2, 3, 5, 5]);

    server.socket.greet();
    server.socket.close();
    expect(connection.state.value).toEqual({ kind: "lost", retryInSeconds: 1 });
  });

  test("the seconds until the next attempt are counted down", () => {
    vi.useFakeTimers();
    for (let i = 0; i < 3; i++) {
      server.socket.close();
      vi.advanceTimersByTime(i < 2 ? 1000 : 0);
    }
    const states: unknown[] = [];
    effect(() => {
      states.push(server.connection.state.value);
    });
    vi.advanceTimersByTime(2000);

    expect(states).toEqual([2, 1, 0].map((retryInSeconds) => ({ kind: "lost", retryInSeconds })));
  });

  test("subscribes again to subscribed topics after a lost connection", async () => {
    vi.useFakeTimers({ toFake: ["setTimeout"] });
    greeted().socket.advertise(3, "/a", "std_msgs/Int8", "int8 data");
    const { received, until } = collect("/a");
    server.socket.message(server.socket.subscription(3), [5]);
    server.socket.close();
    vi.advanceTimersByTime(1000);
    vi.useRealTimers();
    server.socket.greet();
    expect(server.connection.topics.value.size).toBe(0);
    server.socket.advertise(8, "/a", "std_msgs/Int16", "int16 data");
    server.socket.message(server.socket.subscription(8), [1, 1]);

    await until(1);
    expect(received.at(-1)?.message).toEqual({ data: 257 });
    expect(received.at(-1)?.type).toBe("std_msgs/Int16");
  });

  test("a subscription made at reconnection uses no channel of the previous server", () => {
    vi.useFakeTimers({ toFake: ["setTimeout"] });
    greeted().socket.advertise(3, "/a", "std_msgs/Int8", "int8 data");
    server.socket.close();
    server.connection.state.subscribe((state) => {
      if (state.kind === "connected") server.connection.subscribe("/a", () => undefined);
    });
    vi.advanceTimersByTime(1000);
    server.socket.greet();

    expect(server.socket.ops("subscribe")).toEqual([]);
  });
});

describe("topics", () => {
  test("messages of a topic that appears later are decoded", async () => {
    const { received, until } = collect("/scan");
    greeted().socket.advertise(1, "/scan", "a/Scan", "float32[] ranges");
    expect([...server.connection.topics.value.values()]).toEqual([{ name: "/scan", type: "a/Scan", encoding: "ros1" }]);
    server.socket.message(server.socket.subscription(1), [1, 0, 0, 0, 0, 0, 192, 63], 7n);

    await until(1);
    expect(received).toEqual([
      { topic: "/scan", type: "a/Scan", message: { ranges: new Float32Array([1.5]) }, time: 7n, bytes: 8 },
    ]);
  });

  test("the server's own channels are not listed as topics, and are not decoded", () => {
    const payloads: number[] = [];
    server.connection.subscribeRaw("trundle/poses", (payload) => payloads.push(payload.getUint8(0)));
    greeted().socket.advertise(1, "trundle/poses", "", "", "trundle.poses");
    server.socket.message(server.socket.subscription(1), [9]);

    expect(payloads).toEqual([9]);
    expect(server.connection.topics.value.size).toBe(0);
  });

  test("when decoding lags, the newest message wins and the others are counted", async () => {
    greeted().socket.advertise(1, "/a", "std_msgs/Int8", "int8 data");
    const { received, until } = collect("/a");
    for (let i = 0; i < 10; i++) server.socket.message(server.socket.subscription(1), [i]);

    await until(2);
    expect(received.map((one) => one.message["data"])).toEqual([0, 9]);
    expect(server.connection.statistics("/a")).toMatchObject({ count: 10, dropped: 8 });
  });

  test("a subscriber of every message receives all of them, in order", async () => {
    greeted().socket.advertise(1, "/a", "std_msgs/Int8", "int8 data");
    const { received, until } = collect("/a", { every: true });
    for (let i = 0; i < 100; i++) server.socket.message(server.socket.subscription(1), [i]);

    await until(100);
    expect(received.map((one) => one.message["data"])).toEqual([...Array(100).keys()]);
  });

  test("a message that cannot be decoded is reported with a sentence", async () => {
    greeted().socket.advertise(1, "/a", "a/B", "int32 data");
    const { errors, until } = collect("/a");
    server.socket.message(server.socket.subscription(1), [1]);

    await until(1);
    expect(errors).toEqual(["a/B: the field 'data' takes 4 bytes, and the message has 1 more"]);
  });

  test("an unknown encoding is reported", () => {
    greeted().socket.advertise(1, "/a", "a/B", "", "protobuf");
    expect(collect("/a").errors).toEqual(["messages of /a have the encoding protobuf, which the page does not read"]);
  });

  test("one subscription of the socket serves all subscribers, and ends with the last", () => {
    greeted().socket.advertise(1, "/a", "std_msgs/Int8", "int8 data");
    const first = server.connection.subscribe("/a", () => undefined);
    const second = server.connection.subscribe("/a", () => undefined);
    const { socket } = server;
    expect(socket.ops("subscribe")).toHaveLength(2);
    expect(socket.ops("unsubscribe"), "the first, so that the second gets what is latched").toHaveLength(1);

    first.close();
    first.close();
    expect(socket.ops("unsubscribe")).toHaveLength(1);
    second.close();
    expect(socket.ops("unsubscribe")).toHaveLength(2);
    expect(socket.ops("unsubscribe").at(-1)).toEqual({
      op: "unsubscribe",
      subscriptionIds: [socket.subscription(1)],
    });
  });

  test("measuring a topic does not resend latched messages", () => {
    greeted().socket.advertise(1, "/a", "std_msgs/Int8", "int8 data");
    server.socket.advertise(2, "trundle/world", "", "", "json");
    for (const topic of ["/a", "trundle/world"]) {
      server.connection.subscribeRaw(topic, () => undefined);
      server.connection.subscribeRaw(topic, () => undefined);
    }
    const subscribed = server.socket.ops("subscribe").map((frame) => frame["subscriptions"]);
    expect(subscribed).toMatchObject([[{ channelId: 1 }], [{ channelId: 2 }], [{ channelId: 2 }]]);
  });

  test("an error of one subscriber does not affect the others", async () => {
    const error = vi.spyOn(console, "error").mockImplementation(() => undefined);
    greeted().socket.advertise(1, "/a", "std_msgs/Int8", "int8 data");
    server.connection.subscribe("/a", () => {
      throw new Error("a fault");
    });
    const { received, until } = collect("/a");
    server.socket.message(server.socket.subscription(1), [1]);

    await until(1);
    expect(received).toHaveLength(1);
    expect(error).toHaveBeenCalledOnce();
    error.mockRestore();
  });

  test("the server's drops are counted across connections", () => {
    vi.useFakeTimers();
    const drop = (count: number) => {
      server.socket.advertise(9, "trundle/drops", "", "", "json");
      server.socket.message(server.socket.subscription(9), new TextEncoder().encode(JSON.stringify({ "/a": count })));
    };
    server.connection.subscribe("/a", () => undefined);
    greeted();
    drop(3);
    drop(5);
    expect(server.connection.statistics("/a").dropped).toBe(5);
    server.socket.close();
    vi.advanceTimersByTime(1000);
    server.socket.greet();
    drop(2);
    expect(server.connection.statistics("/a").dropped).toBe(7);
  });
});

describe("a slow connection", () => {
  test("marks are echoed after what came before them", () => {
    greeted();
    server.socket.mark(7, 1000);
    expect(server.socket.ops("trundle/echo")).toEqual([{ op: "trundle/echo", mark: 7 }]);
  });

  test("parts of a long message arrive whole, with others between them", () => {
    greeted();
    server.socket.advertise(1, "/long", "test/Long", "uint8[] data");
    server.socket.advertise(2, "/short", "test/Short", "uint8 data");
    const payloads: Record<string, number[][]> = { "/long": [], "/short": [] };
    for (const [topic, all] of Object.entries(payloads))
      server.connection.subscribeRaw(topic, (payload) =>
        all.push([...new Uint8Array(payload.buffer, payload.byteOffset)]),
      );
    const bytes = messageBytes(server.socket.subscription(1), [5, 6, 7, 8, 9]);
    server.socket.part(4, bytes.slice(0, 10), false);
    server.socket.message(server.socket.subscription(2), [1]);
    server.socket.part(4, bytes.slice(10, 24), false);
    expect(payloads).toEqual({ "/long": [], "/short": [[1]] });

    server.socket.part(4, bytes.slice(24), true);
    expect(payloads["/long"]).toEqual([[5, 6, 7, 8, 9]]);
  });

  test("text comes in parts, too", () => {
    greeted();
    const text = new TextEncoder().encode(JSON.stringify({ op: "status", level: 1, message: "it is hot" }));
    server.socket.part(9, text.slice(0, 8), false, true);
    server.socket.part(9, text.slice(8), true, true);
    expect(server.connection.notices.value.map((notice) => notice.text)).toEqual(["it is hot"]);
  });

  test("rate and age are by the server's time", () => {
    vi.useFakeTimers();
    greeted();
    server.socket.advertise(1, "/a", "test/A", "uint8 data");
    server.connection.subscribeRaw("/a", () => undefined);
    const send = (at: number): void => server.socket.message(server.socket.subscription(1), [1], 0n, at);
    for (let at = 0; at <= 1000; at += 100) {
      send(at);
      vi.advanceTimersByTime(at < 1000 ? 100 : 900);
    }
    for (let at = 1100; at <= 2000; at += 100) send(at - 100); // late, all at once

    const { rate, lastAt } = server.connection.statistics("/a");
    expect(rate).toBeGreaterThan(9);
    expect(rate).toBeLessThan(12);
    expect(performance.now() - (lastAt ?? 0)).toBeCloseTo(0, 0);
  });
});
