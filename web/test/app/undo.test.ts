import { expect, it } from "vitest";

import { UndoHistory } from "../../src/app/undo";

it("takes edits back and does them again, with their titles", () => {
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
