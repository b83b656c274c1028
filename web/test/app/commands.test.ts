// @vitest-environment jsdom
import { describe, expect, it } from "vitest";

import { CommandList, keysOf, listenForKeys, takesKeys } from "../../src/app/commands";

const key = (init: KeyboardEventInit): KeyboardEvent => new KeyboardEvent("keydown", init);

describe("keys", () => {
  it("have the names that commands use", () => {
    expect(keysOf(key({ key: " " }))).toBe("Space");
    expect(keysOf(key({ key: "R", shiftKey: true }))).toBe("Shift R");
    expect(keysOf(key({ key: "k", ctrlKey: true }))).toBe("Ctrl K");
    expect(keysOf(key({ key: "?", shiftKey: true }))).toBe("?");
    expect(keysOf(key({ key: "Z", ctrlKey: true, shiftKey: true }))).toBe("Ctrl Shift Z");
  });

  it("go to a focused field", () => {
    const field = document.createElement("input");
    const button = document.createElement("button");
    expect(takesKeys(field, "w")).toBe(true);
    expect(takesKeys(button, " ")).toBe(true);
    expect(takesKeys(button, "w")).toBe(false);
    expect(takesKeys(document.body, " ")).toBe(false);
  });

  it("go to a slider only if they move it", () => {
    const slider = Object.assign(document.createElement("input"), { type: "range" });
    expect(takesKeys(slider, "w")).toBe(false);
    expect(takesKeys(slider, "ArrowLeft")).toBe(true);
    expect(takesKeys(slider, "End")).toBe(true);
  });

  it("run an enabled command until it is removed", () => {
    const commands = new CommandList();
    let ran = 0;
    let enabled = false;
    const remove = commands.add({
      id: "a",
      title: "A",
      group: "View",
      keys: "F",
      enabled: () => enabled,
      run: () => (ran += 1),
    });
    expect(commands.press("F")).toBe(false);
    enabled = true;
    expect(commands.press("F")).toBe(true);
    remove();
    expect([commands.press("F"), ran]).toEqual([false, 1]);
  });

  it("with Space run the page's command after a mouse click on a button, and press the button after keyboard focus", () => {
    const commands = new CommandList();
    let played = 0;
    commands.add({ id: "play", title: "Play", group: "Simulation", keys: "Space", run: () => (played += 1) });
    const stop = listenForKeys(commands);
    const button = document.body.appendChild(document.createElement("button"));
    const press = (name: string): boolean => button.dispatchEvent(key({ key: name, bubbles: true, cancelable: true }));
    button.focus();
    expect([press(" "), played]).toEqual([true, 0]);
    button.dispatchEvent(new MouseEvent("click", { detail: 1, bubbles: true }));
    expect([press(" "), played]).toEqual([false, 1]);
    press("Tab");
    expect([press(" "), played]).toEqual([true, 1]);
    stop();
    button.remove();
  });
});
