import { signal } from "@preact/signals";
import { expect, test } from "vitest";

import type { Selection } from "../../src/page/page";
import { colorOf, followPeople, others } from "../../src/page/people";
import { FakeConnection } from "../fake_connection";

const LINK: Selection = { kind: "link", model: "cart", link: "base" };

function tell(connection: FakeConnection, you: number, ...numbers: number[]): void {
  const people = numbers.map((number) => ({ number, view_only: false, selection: null }));
  connection.receiveRaw(
    "trundle/people",
    new DataView(new TextEncoder().encode(JSON.stringify({ you, people })).buffer),
  );
}

test("the selection is sent once people are known, and at each change", () => {
  const connection = new FakeConnection();
  const selection = signal<Selection | null>(LINK);
  followPeople(connection, selection);
  expect(connection.presented).toEqual([]);
  tell(connection, 1, 1);
  tell(connection, 1, 1, 2);
  selection.value = null;

  expect(connection.presented).toEqual([LINK, null]);
});

test("the selection is sent again to a new server", () => {
  const connection = new FakeConnection();
  const people = followPeople(connection, signal<Selection | null>(LINK));
  tell(connection, 2, 1, 2);
  connection.state.value = { kind: "lost", retryInSeconds: 1 };
  expect(people.value.people).toEqual([]);
  connection.state.value = { kind: "connected" };
  tell(connection, 1, 1);

  expect(connection.presented).toEqual([LINK, LINK]);
});

test("selections outside the simulated world are not sent", () => {
  const connection = new FakeConnection();
  followPeople(connection, signal<Selection | null>({ kind: "picked", title: "Marker", fields: { id: 1 } }));
  tell(connection, 1, 1);

  expect(connection.presented).toEqual([null]);
});

test("each other person has a color", () => {
  const connection = new FakeConnection();
  const people = followPeople(connection, signal<Selection | null>(null));
  tell(connection, 2, 1, 2, 3, 7);

  expect(others(people.value).map(colorOf)).toEqual(["--person-1", "--person-3", "--person-1"]);
});
