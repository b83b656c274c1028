import { afterEach, beforeEach, expect, test, vi } from "vitest";

import { FakeServer, u64 } from "./fake_server";

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

test("parameters are received while subscribed", () => {
  greeted();
  expect(server.socket.sent).toEqual([]);
  const stop = server.connection.parameters.subscribe(() => undefined);
  expect(server.socket.sent.map((frame) => (frame as Record<string, unknown>)["op"])).toEqual([
    "subscribeParameterUpdates",
    "getParameters",
  ]);
  server.socket.text({
    op: "parameterValues",
    parameters: [
      { name: "/a", value: [1] },
      { name: "/b", value: "x" },
    ],
  });
  server.socket.text({ op: "parameterValues", parameters: [{ name: "/b" }] });
  expect(server.connection.parameters.value).toEqual(new Map([["/a", [1]]]));
  stop();
  expect(server.socket.ops("unsubscribeParameterUpdates")).toHaveLength(1);

  server.connection.setParameter("/a", undefined);
  expect(server.socket.ops("setParameters")[0]).toEqual({
    op: "setParameters",
    parameters: [{ name: "/a" }],
    id: "set",
  });
});

test("whole floats stay floats", () => {
  greeted();
  server.socket.text({
    op: "parameterValues",
    parameters: [
      { name: "/a", value: 1, type: "float64" },
      { name: "/b", value: [1], type: "float64_array" },
      { name: "/c", value: 1 },
    ],
  });
  expect(server.connection.floatParameters.value).toEqual(new Set(["/a", "/b"]));
  server.connection.setParameter("/a", 2);
  server.connection.setParameter("/b", [2]);
  server.connection.setParameter("/c", 2);
  expect(server.socket.ops("setParameters").map((frame) => frame["parameters"])).toEqual([
    [{ name: "/a", value: 2, type: "float64" }],
    [{ name: "/b", value: [2], type: "float64_array" }],
    [{ name: "/c", value: 2 }],
  ]);
  server.socket.text({ op: "parameterValues", parameters: [{ name: "/a", value: "x" }, { name: "/b" }] });
  expect(server.connection.floatParameters.value.size).toBe(0);
});

test("a server without the graph capability gets no graph subscription", () => {
  server.connection.parameters.subscribe(() => undefined);
  server.connection.graph.subscribe(() => undefined)();
  server.socket.greet(["assets", "time"]);

  expect(server.socket.sent).toEqual([]);
});

test("the graph is received while subscribed, and again after a lost connection", () => {
  vi.useFakeTimers();
  server.connection.graph.subscribe(() => undefined);
  greeted();
  expect(server.socket.ops("subscribeConnectionGraph")).toHaveLength(1);
  const update = {
    publishedTopics: [],
    subscribedTopics: [],
    advertisedServices: [],
    removedTopics: [],
    removedServices: [],
  };
  server.socket.text({
    op: "connectionGraphUpdate",
    ...update,
    publishedTopics: [{ name: "/a", publisherIds: ["/n"] }],
    advertisedServices: [{ name: "/s", providerIds: ["/n"] }],
  });
  server.socket.text({
    op: "connectionGraphUpdate",
    ...update,
    subscribedTopics: [{ name: "/a", subscriberIds: ["/m"], type: "std_msgs/String" }],
  });
  expect(server.connection.graph.value).toEqual({
    types: new Map([["/a", "std_msgs/String"]]),
    publishers: new Map([["/a", ["/n"]]]),
    subscribers: new Map([["/a", ["/m"]]]),
    services: new Map([["/s", ["/n"]]]),
  });
  server.socket.text({ op: "connectionGraphUpdate", ...update, removedTopics: ["/a"], removedServices: ["/s"] });
  expect(server.connection.graph.value.publishers.size + server.connection.graph.value.services.size).toBe(0);

  server.socket.close();
  vi.advanceTimersByTime(1000);
  server.socket.greet();
  expect(server.socket.ops("subscribeConnectionGraph")).toHaveLength(1);
});

test("notices are replaced and removed by their id", () => {
  greeted();
  const texts = () => server.connection.notices.value.map((notice) => `${notice.level}: ${notice.text}`);
  server.socket.text({ op: "status", level: 0, message: "one" });
  server.socket.text({ op: "status", level: 1, message: "two", id: "a" });
  server.socket.text({ op: "status", level: 2, message: "three", id: "a" });
  expect(texts()).toEqual(["info: one", "error: three"]);
  server.socket.text({ op: "removeStatus", statusIds: ["a"] });
  expect(texts()).toEqual(["info: one"]);
});

test("time is the server's if sent, otherwise the wall clock's", () => {
  vi.useFakeTimers({ now: 5000 });
  expect(greeted().connection.now()).toBe(5_000_000_000n);
  server.socket.binary([2], u64(12_500n));
  expect(server.connection.now()).toBe(12_500n);
  server.socket.close();
  vi.advanceTimersByTime(1000);
  server.socket.greet();
  expect(server.connection.now()).toBe(6_000_000_000n);
});
