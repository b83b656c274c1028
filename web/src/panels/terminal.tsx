/** Terminals of nodes that read keys or draw on a screen: launch-prefix="xterm -e" (xterm). */

import "@xterm/xterm/css/xterm.css";

import { signal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";

import { canControl, VIEW_ONLY } from "../page/view_only";
import type { Page } from "../page/page";
import { Tabs } from "../theme/tabs";
import type { Panel, PanelProps } from "./panel";
import { perPage } from "./per_page";
import { TerminalView } from "./terminal/terminal_view";
import { useShown } from "./use";

const RESIZE_PERIOD = 100; // ms

class TerminalsState {
  /** Index of the shown terminal in the session's list. */
  readonly shown = signal(0);
  /** Open terminal; null: none yet. */
  private view: TerminalView | null = null;
  private isChosen = false;

  /** Show a terminal and focus it. */
  choose(number: number): void {
    this.isChosen = true;
    if (number === this.shown.peek()) this.opened(this.view);
    else this.shown.value = number;
  }

  opened(view: TerminalView | null): void {
    this.view = view;
    if (!this.isChosen) return;
    view?.focus();
    this.isChosen = view === null;
  }
}

const terminalsState = perPage(() => new TerminalsState());

function Terminals({ page }: PanelProps): JSX.Element {
  const state = terminalsState(page);
  const { terminals } = page.session;
  if (terminals.length === 0)
    return (
      <div class="empty">
        No node asks for a terminal: launch-prefix="xterm -e" in the launch file gives it one here.
      </div>
    );
  const number = Math.min(state.shown.value, terminals.length - 1);
  const items = terminals.map(({ name, ended }, index) => ({
    id: String(index),
    title: ended === null ? name : `${name} (ended)`,
  }));
  return (
    <div class="stack">
      {terminals.length > 1 && (
        <div class="toolrow">
          <Tabs label="Nodes" items={items} selected={String(number)} onSelect={(id) => state.choose(Number(id))} />
        </div>
      )}
      {!canControl(page) && <p class="sm t2 pad">{VIEW_ONLY}</p>}
      <Screen key={number} page={page} number={number} />
    </div>
  );
}

function Screen({ page, number }: { readonly page: Page; readonly number: number }): JSX.Element {
  const element = useRef<HTMLDivElement>(null);
  const opening = useRef<Promise<TerminalView> | null>(null);
  const isShown = useShown(element);
  const isConnected = page.connection.state.value.kind === "connected";
  const theme = page.theme.value;
  useEffect(() => {
    const { current } = element;
    if (current === null || !isShown || !isConnected) return;
    const state = terminalsState(page);
    let close: (() => void) | null = null;
    let isClosed = false;
    opening.current ??= TerminalView.open(current, page.connection, number, canControl(page));
    void opening.current.then((view) => {
      if (isClosed) return;
      close = follow(view, current);
      state.opened(view);
    });
    return () => {
      isClosed = true;
      close?.();
      state.opened(null);
    };
  }, [page, number, isShown, isConnected]);
  useEffect(() => void opening.current?.then((view) => view.recolor()), [theme]);
  useEffect(() => () => void opening.current?.then((view) => view.close()), []);
  return <div class="terminalhost" ref={element} />;
}

/** Show a terminal's output, and ask for the size of its element, until the returned function is called. */
function follow(view: TerminalView, element: HTMLElement): () => void {
  const end = view.follow();
  let timer: ReturnType<typeof setTimeout> | undefined;
  const fit = (): void => {
    clearTimeout(timer);
    timer = setTimeout(() => view.requestSize(), RESIZE_PERIOD);
  };
  const observer = new ResizeObserver(fit);
  observer.observe(element);
  element.addEventListener("focusin", fit);
  return () => {
    end();
    clearTimeout(timer);
    observer.disconnect();
    element.removeEventListener("focusin", fit);
  };
}

function Actions({ page }: PanelProps): JSX.Element | null {
  const [only, ...others] = page.session.terminals;
  return only === undefined || others.length > 0 ? null : (
    <span class="sm t2">{only.ended === null ? only.name : `${only.name} (ended)`}</span>
  );
}

export const terminalPanel: Panel = {
  id: "terminal",
  title: "Terminal",
  programs: ["xterm"],
  component: Terminals,
  actions: Actions,
};
