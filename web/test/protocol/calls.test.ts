import { afterEach, beforeEach, expect, test, vi } from "vitest";

import { FakeServer, u32 } from "./fake_server";

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

test("calls a service", async () => {
  greeted().socket.text({
    op: "advertiseServices",
    services: [
      {
        id: 4,
        name: "/add",
        type: "a/Add",
        request: { encoding: "ros1", schemaName: "a/AddRequest", schemaEncoding: "ros1msg", schema: "int8 a\nint8 b" },
        response: { encoding: "ros1", schemaName: "a/AddResponse", schemaEncoding: "ros1msg", schema: "int8 sum" },
        requestSchema: "int8 a\nint8 b",
        responseSchema: "int8 sum",
      },
    ],
  });
  const sum = server.connection.callService("/add", { a: 1, b: 2 });
  const frame = new Uint8Array(server.socket.sent.at(-1) as ArrayBuffer);
  expect([...frame]).toEqual([2, ...u32(4), ...u32(0), ...u32(4), ...new TextEncoder().encode("ros1"), 1, 2]);
  server.socket.binary([3], u32(4), u32(0), u32(4), new TextEncoder().encode("ros1"), [3]);
  await expect(sum).resolves.toEqual({ sum: 3 });

  const fails = server.connection.callService("/add", {});
  server.socket.text({ op: "serviceCallFailure", serviceId: 4, callId: 1, message: "too large" });
  await expect(fails).rejects.toThrow("too large");
  await expect(server.connection.callService("/none", {})).rejects.toThrow("there is no service /none");
});

test("fetches assets", async () => {
  const asset = greeted().connection.fetchAsset("package://a/b.stl");
  const missing = server.connection.fetchAsset("package://a/c.stl");
  expect(server.socket.ops("fetchAsset")).toEqual([
    { op: "fetchAsset", uri: "package://a/b.stl", requestId: 0 },
    { op: "fetchAsset", uri: "package://a/c.stl", requestId: 1 },
  ]);
  server.socket.binary([4], u32(1), [1], u32(4), new TextEncoder().encode("gone"));
  server.socket.binary([4], u32(0), [0], u32(0), [1, 2, 3]);

  await expect(asset).resolves.toEqual(new Uint8Array([1, 2, 3]).buffer);
  await expect(missing).rejects.toThrow("gone");
});

test("makes requests", async () => {
  const done = greeted().connection.request("step", { count: 3 });
  const refused = server.connection.request("seek", { time_ns: 1 });
  expect(server.socket.ops("trundle/request")[0]).toEqual({ op: "trundle/request", id: 0, request: "step", count: 3 });
  server.socket.answer(0);
  server.socket.text({ op: "trundle/response", id: 1, ok: false, error: "this run is not recorded" });

  await expect(done).resolves.toMatchObject({ ok: true });
  await expect(refused).rejects.toThrow("this run is not recorded");
});

test("pending requests are rejected at a lost connection, and new ones without a connection", async () => {
  vi.useFakeTimers();
  const result = greeted().connection.request("play", {});
  server.socket.close();
  await expect(result).rejects.toThrow("the connection was lost before the answer came");
  await expect(server.connection.fetchAsset("file:///a")).rejects.toThrow("the page is not connected");
});

test("publishes with the topic's definition, otherwise the server's", async () => {
  greeted().socket.advertise(1, "/other", "a/B", "int8 x");
  server.connection.publish("/goal", "a/B", { x: 7 });
  server.connection.publish("/cmd", "a/C", { y: 1 });
  server.connection.publish("/goal", "a/B", { x: 8 });
  server.connection.publish("/cmd", "a/C", { y: 2 });
  const requests = server.socket.ops("trundle/request");
  expect(requests).toEqual([{ op: "trundle/request", id: 0, request: "definition", type: "a/C" }]);
  server.socket.answer(0, { definition: "int16 y" });

  const frames = () => server.socket.sent.filter((frame) => frame instanceof ArrayBuffer);
  await vi.waitFor(() => expect(frames()).toHaveLength(4));
  expect(server.socket.ops("advertise").map((frame) => frame["channels"])).toEqual([
    [{ id: 1, topic: "/goal", encoding: "ros1", schemaName: "a/B" }],
    [{ id: 2, topic: "/cmd", encoding: "ros1", schemaName: "a/C" }],
  ]);
  expect(frames().map((frame) => [...new Uint8Array(frame)])).toEqual([
    [1, ...u32(1), 7],
    [1, ...u32(1), 8],
    [1, ...u32(2), 1, 0],
    [1, ...u32(2), 2, 0],
  ]);
});

test("a failed publication becomes a notice", async () => {
  greeted().socket.advertise(1, "/other", "std_msgs/Bool", "bool data");
  server.connection.publish("/a", "std_msgs/Bool", { data: 1 });
  server.connection.publish("/b", "b/Unknown", {});
  server.socket.text({ op: "trundle/response", id: 0, ok: false, error: "there is no type b/Unknown" });

  await vi.waitFor(() => expect(server.connection.notices.value).toHaveLength(2));
  expect(server.connection.notices.value.map((notice) => notice.text)).toEqual([
    'Nothing was published on /a: std_msgs/Bool.data is a bool, not "1"',
    "Nothing was published on /b: there is no type b/Unknown",
  ]);
});

test("drives by a worker, whose refusals are notices", () => {
  const { connection } = greeted();
  connection.prepareDriving();
  connection.drive("/cmd_vel", 0.5, -1);
  connection.release();

  expect(server.driveRequests).toEqual([
    { kind: "open", url: "ws://here/" },
    { kind: "drive", command: { topic: "/cmd_vel", linear: 0.5, angular: -1 } },
    { kind: "release" },
  ]);
  expect(server.socket.sent).toEqual([]);

  server.reportDriving({ kind: "delay", delay: 0.4 });
  server.reportDriving({ kind: "fault", text: "/cmd_vel cannot be driven" });
  expect(connection.driveDelay.value).toBe(0.4);
  expect(connection.notices.value).toMatchObject([{ level: "error", text: "/cmd_vel cannot be driven" }]);
});
