/** Messages that the page cannot read: of another version, or broken. */

import { afterEach, beforeEach, expect, test } from "vitest";

import type { PageSession } from "../../src/protocol/generated/page_messages";
import { SESSION } from "../fake_page";
import { FakeServer } from "./fake_server";

const VERSION = "The server may be of another version: load the page again.";

let server: FakeServer;
beforeEach(() => {
  server = new FakeServer();
  server.socket.greet();
});
afterEach(() => {
  server.close();
});

function notices(): readonly string[] {
  return server.connection.notices.value.map(({ text }) => text);
}

/** The server sends a channel's message as JSON. */
function send(topic: string, message: unknown): void {
  server.socket.advertise(1, topic, "", "", "json");
  server.socket.message(server.socket.subscription(1), new TextEncoder().encode(JSON.stringify(message)));
}

test.each([
  ["a text that is not JSON", "{", "a message: it is not JSON"],
  ["a text without an object", "[]", "a message: it is not an object"],
  ["an unknown message", '{"op": "dance"}', "a message: 'op' has the unknown value 'dance'"],
  ["an operation of Object's", '{"op": "constructor"}', "a message: 'op' has the unknown value 'constructor'"],
  ["a message without a field", '{"op": "status", "level": 1}', "a message: 'message' is missing"],
  ["a field of another type", '{"op": "removeStatus", "statusIds": [7]}', "a message: 'statusIds[0]' is not a text"],
])("%s ends in a notice", (_, text, reason) => {
  server.socket.raw(text);

  expect(notices()).toEqual([`The page cannot read ${reason}. ${VERSION}`]);
  server.socket.text({ op: "status", level: 0, message: "hello" });
  expect(notices()).toContain("hello");
});

test.each([
  ["a message that is cut off", [1, 0, 0]],
  ["an unknown opcode", [200]],
  ["nothing", []],
])("%s in binary ends in a notice", (_, bytes) => {
  server.socket.binary(bytes);

  expect(notices()).toHaveLength(1);
  expect(notices()[0]).toMatch(/^The page cannot read a binary message: /);
});

test("a repeated fault is one notice", () => {
  for (let i = 0; i < 3; i++) server.socket.raw("{");

  expect(notices()).toHaveLength(1);
});

test("a channel's message without a field becomes a notice, and is not delivered", () => {
  const sessions: PageSession[] = [];
  server.connection.subscribeJson("trundle/session", (session) => sessions.push(session));
  send("trundle/session", { ...SESSION, rviz: { name: "a.rviz", text: "", writable: true } });

  expect(sessions).toEqual([]);
  expect(notices()).toEqual([`The page cannot read trundle/session: 'rviz.saved' is missing. ${VERSION}`]);
});

test("unknown fields are accepted", () => {
  const sessions: PageSession[] = [];
  server.connection.subscribeJson("trundle/session", (session) => sessions.push(session));
  send("trundle/session", { ...SESSION, mood: "sunny" });

  expect(sessions).toHaveLength(1);
  expect(notices()).toEqual([]);
});

test("an answer without its fields rejects the request with a sentence", async () => {
  const models = server.connection.request("models", {});
  const saved = server.connection.request("save_world", { file: "a.sdf" });
  server.socket.answer(0, { models: [{ name: "cart", title: "Cart", description: "" }] });
  server.socket.answer(1, { file: "a.sdf" });

  await expect(models).rejects.toThrow(
    `The page cannot read the answer to 'models': 'models[0].uploaded' is missing. ${VERSION}`,
  );
  await expect(saved).rejects.toThrow(/^The page cannot read the answer to 'save_world': /);
});

test("a union of answers is read", async () => {
  const saved = server.connection.request("save_world", { file: "a.sdf" });
  server.socket.answer(0, { exists: "a.sdf" });

  await expect(saved).resolves.toMatchObject({ exists: "a.sdf" });
});
