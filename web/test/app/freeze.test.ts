import { signal } from "@preact/signals";
import { expect, it } from "vitest";

import { freezable } from "../../src/app/freeze";
import { FakeConnection } from "../fake_connection";

it("buffers messages and stops time while frozen, and delivers them afterwards", () => {
  const connection = new FakeConnection();
  const frozen = signal(false);
  const view = freezable(connection, frozen);
  const got: unknown[] = [];
  const subscription = view.subscribe("/scan", ({ message }) => got.push(message["n"]));
  connection.time = 5n;
  connection.receive("/scan", { n: 1 });
  frozen.value = true;
  connection.time = 9n;
  for (let n = 2; n < 40; n += 1) connection.receive("/scan", { n });
  expect([got, view.now()]).toEqual([[1], 5n]);
  frozen.value = false;
  expect([got.length, got.at(-1), view.now()]).toEqual([21, 39, 9n]);
  subscription.close();
  expect(connection.subscriptions("/scan")).toBe(0);
});
