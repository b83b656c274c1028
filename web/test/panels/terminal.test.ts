import { Terminal } from "@xterm/xterm";
import { beforeEach, expect, test } from "vitest";

import { OutputFeed, type Screen } from "../../src/panels/terminal/output_feed";
import { silence } from "../../src/panels/terminal/quiet";

const bytes = (text: string): Uint8Array => new TextEncoder().encode(text);

/** A screen that draws when it is told to. */
class SlowScreen implements Screen {
  shown = "";
  private done: (() => void) | null = null;
  write(data: Uint8Array, done: () => void): void {
    this.shown += new TextDecoder().decode(data);
    this.done = done;
  }
  reset(): void {
    this.shown = "";
  }
  draw(): void {
    const { done } = this;
    this.done = null;
    done?.();
  }
}

let screen: SlowScreen;
let feed: OutputFeed;

beforeEach(() => {
  screen = new SlowScreen();
  feed = new OutputFeed(screen);
});

test("repeated output is shown once", () => {
  feed.receive(0, bytes("abc"));
  feed.receive(0, bytes("abcdef"));
  feed.receive(6, bytes("ghi"));
  screen.draw();
  expect(screen.shown).toBe("abcdefghi");
});

test("the screen is reset after a gap", () => {
  feed.receive(0, bytes("abc"));
  screen.draw();
  feed.receive(100, bytes("xyz"));
  expect(screen.shown).toBe("xyz");
});

test("the screen is reset for another server's output", () => {
  feed.receive(0, bytes("abc"));
  screen.draw();
  feed.restart();
  feed.receive(0, bytes("another"));
  expect(screen.shown).toBe("another");
});

test("a slow screen gets only the end of the output", () => {
  feed.receive(0, bytes("start"));
  const line = "0123456789abcdef".repeat(4096);
  for (let i = 0; i < 40; i += 1) feed.receive(5 + i * line.length, bytes(line));
  screen.draw();
  expect(screen.shown.length).toBeLessThanOrEqual(1024 * 1024);
  expect(screen.shown.endsWith(line)).toBe(true);
});

test.each([
  ["device attributes", "\u001b[c\u001b[0c\u001b[>c"],
  ["cursor and status", "\u001b[5n\u001b[6n\u001b[?6n"],
  ["modes", "\u001b[4$p\u001b[?25$p"],
  ["status strings", '\u001bP$qm\u001b\\\u001bP$q"p\u001b\\'],
  ["colors", "\u001b]4;1;?\u0007\u001b]10;?\u0007\u001b]11;?\u0007\u001b]12;?\u0007"],
  ["the window", "\u001b[14t\u001b[16t\u001b[18t\u001b[21t"],
  ["focus", "\u001b[?1004h"],
])("a program's question about %s types nothing", async (_, question) => {
  const terminal = new Terminal();
  silence(terminal);
  const answers: string[] = [];
  terminal.onData((text) => answers.push(text));
  await new Promise<void>((resolve) => terminal.write(question, resolve));
  expect(answers).toEqual([]);
});

test("titles and links of a program do not change the page", async () => {
  const terminal = new Terminal();
  silence(terminal);
  const titles: string[] = [];
  terminal.onTitleChange((title) => titles.push(title));
  await new Promise<void>((resolve) =>
    terminal.write(
      "\u001b]0;evil\u0007\u001b]2;evil\u0007\u001b]8;;javascript:alert(1)\u0007text\u001b]8;;\u0007",
      resolve,
    ),
  );
  expect(titles).toEqual([]);
  expect(terminal.buffer.active.getLine(0)?.translateToString(true)).toBe("text");
});
