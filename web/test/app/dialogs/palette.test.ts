import { expect, it } from "vitest";

import type { Command } from "../../../src/page/page";
import { search } from "../../../src/app/dialogs/palette";

const command = (title: string, enabled = true): Command => ({
  id: title,
  title,
  group: "View",
  enabled: () => enabled,
  run: () => undefined,
});

it("finds commands by all words, those that begin with the text first", () => {
  const commands = [
    command("Show or hide the dock"),
    command("Open Plots"),
    command("Dock to the left"),
    command("Dock it", false),
  ];
  expect(search(commands, "dock").map(({ title }) => title)).toEqual(["Dock to the left", "Show or hide the dock"]);
  expect(search(commands, "hide dock").length).toBe(1);
  expect(search(commands, "").length).toBe(3);
});
