/** One terminal in an element: xterm.js with the page's colors, fed by the server. */

import type { FitAddon } from "@xterm/addon-fit";
import type { ITheme, Terminal } from "@xterm/xterm";

import type { Connection } from "../../protocol/connection";
import { OutputFeed } from "./output_feed";
import { silence } from "./quiet";

const SCROLLBACK = 5000; // lines
const TEXT_PX = 12; // --text-sm
const FONT = '"SF Mono", "Cascadia Mono", "DejaVu Sans Mono", "Liberation Mono", monospace';
const HEADER = 12; // bytes
/** Characters per message; the server takes as many. */
const AT_ONCE = /[\s\S]{1,4096}/gu;
/** Tokens of ANSI colors: black, red, green, yellow, blue, magenta, cyan, white. */
const ANSI = ["--raised", "--error", "--ok", "--warn", "--z", "--plot-3", "--accent", "--text-2"] as const;
const NAMES = ["Black", "Red", "Green", "Yellow", "Blue", "Magenta", "Cyan", "White"] as const;

/** Size of a terminal in characters. */
type Size = readonly [columns: number, rows: number];

export class TerminalView {
  private readonly feed: OutputFeed;

  private constructor(
    private readonly terminal: Terminal,
    private readonly fit: FitAddon,
    private readonly element: HTMLElement,
    private readonly connection: Connection,
    private readonly number: number,
    private readonly canType: boolean,
  ) {
    this.feed = new OutputFeed(terminal);
    silence(terminal);
    terminal.open(element);
    terminal.textarea?.setAttribute("aria-label", "Keys for the node");
    terminal.attachCustomKeyEventHandler((event) => !(event.key === "Tab" && event.shiftKey)); // leaves the terminal
    if (canType) terminal.onData((text) => this.type(text));
  }

  /** Load xterm.js, which few pages use, and open a terminal in an element. */
  static async open(
    element: HTMLElement,
    connection: Connection,
    number: number,
    canType: boolean,
  ): Promise<TerminalView> {
    const [{ Terminal }, { FitAddon }] = await Promise.all([import("@xterm/xterm"), import("@xterm/addon-fit")]);
    const terminal = new Terminal({
      scrollback: SCROLLBACK,
      fontFamily: FONT,
      fontSize: TEXT_PX,
      lineHeight: 1.2,
      disableStdin: !canType,
      minimumContrastRatio: 4.5,
      linkHandler: { activate: () => undefined },
      theme: themeOf(element),
    });
    const fit = new FitAddon();
    terminal.loadAddon(fit);
    return new TerminalView(terminal, fit, element, connection, number, canType);
  }

  /** Show the output until the returned function is called. */
  follow(): () => void {
    this.feed.restart();
    const subscription = this.connection.subscribeRaw(`trundle/terminal/${this.number}`, (payload) =>
      this.receive(payload),
    );
    return () => subscription.close();
  }

  /** Request the size of the element for the terminal; of several people, the last request wins. */
  requestSize(): void {
    const size = this.fit.proposeDimensions();
    if (!this.canType || size === undefined || !(size.cols > 1 && size.rows > 1)) return;
    const shown: Size = [Math.min(size.cols, 500), Math.min(size.rows, 500)];
    if (shown[0] !== this.terminal.cols || shown[1] !== this.terminal.rows)
      this.connection.useTerminal(this.number, "", shown);
  }

  recolor(): void {
    this.terminal.options.theme = themeOf(this.element);
  }

  focus(): void {
    this.terminal.focus();
  }

  close(): void {
    this.terminal.dispose();
  }

  private type(text: string): void {
    for (const [part] of text.matchAll(AT_ONCE)) this.connection.useTerminal(this.number, part);
  }

  private receive(payload: DataView): void {
    const [columns, rows]: Size = [payload.getUint16(8, true), payload.getUint16(10, true)];
    if (columns !== this.terminal.cols || rows !== this.terminal.rows) this.terminal.resize(columns, rows);
    const first = Number(payload.getBigUint64(0, true));
    this.feed.receive(first, new Uint8Array(payload.buffer, payload.byteOffset + HEADER, payload.byteLength - HEADER));
  }
}

/** The page's colors for a terminal. */
function themeOf(element: Element): ITheme {
  const style = getComputedStyle(element);
  const color = (token: string): string => style.getPropertyValue(token).trim();
  const ansi = new Map(NAMES.map((name, index) => [name, color(ANSI[index] ?? "--text")]));
  return {
    ...Object.fromEntries([...ansi].map(([name, value]) => [name.toLowerCase(), value])),
    ...Object.fromEntries([...ansi].map(([name, value]) => [`bright${name}`, value])),
    background: color("--sunken"),
    foreground: color("--text"),
    cursor: color("--accent"),
    cursorAccent: color("--on-accent"),
    selectionBackground: color("--accent-soft"),
    brightBlack: color("--text-3"),
    brightWhite: color("--text"),
  };
}
