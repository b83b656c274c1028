import { expect, it, vi } from "vitest";

import { UndoHistory } from "../../src/app/undo";

it("undoes and redoes edits, with their titles", () => {
  const undo = new UndoHistory();
  let value = 0;
  const set = (to: number) => () => {
    value = to;
  };
  undo.run("Change of Alpha", set(1), set(0));
  undo.run("Change of Size", set(2), set(1));
  expect([value, undo.undoTitle.value, undo.redoTitle.value]).toEqual([2, "Change of Size", null]);
  undo.undo();
  undo.undo();
  undo.undo();
  expect([value, undo.undoTitle.value, undo.redoTitle.value]).toEqual([0, null, "Change of Alpha"]);
  undo.redo();
  expect([value, undo.redoTitle.value]).toEqual([1, "Change of Size"]);
  undo.run("Change of Name", set(7), set(1));
  expect(undo.redoTitle.value).toBeNull();
});

it("undoes nothing earlier while an edit is in progress", async () => {
  const undo = new UndoHistory();
  const taken: string[] = [];
  const record = (title: string): void =>
    undo.record(
      title,
      () => undefined,
      () => taken.push(title),
    );
  let answer = (): void => undefined;
  record("first");
  const edit = undo.ask(new Promise<void>((resolve) => (answer = resolve)).then(() => record("second")));
  undo.undo();
  expect(taken).toEqual([]);
  answer();
  await edit;
  await vi.waitFor(() => expect(taken).toEqual(["second"]));
  undo.undo();
  expect(taken).toEqual(["second", "first"]);
});

it("continues after a failed edit", async () => {
  const undo = new UndoHistory();
  const taken: string[] = [];
  undo.record(
    "first",
    () => undefined,
    () => taken.push("first"),
  );
  const edit = undo.ask(Promise.reject(new Error("refused")));
  undo.undo();
  await expect(edit).rejects.toThrow("refused");
  await vi.waitFor(() => expect(taken).toEqual(["first"]));
});
