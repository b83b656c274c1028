/** A panel at the left or right: pages in tabs, or a rail that names them. */

import type { JSX } from "preact";

import { Button } from "../theme/button";
import { Tabs } from "../theme/tabs";
import { SIDE, type SideName, type SidePage } from "./layout";
import type { Shell } from "./shell";
import { sidePages } from "./side_pages";

interface SidePanelProps {
  readonly shell: Shell;
  readonly side: SideName;
}

const LABELS: Readonly<Record<SideName, string>> = { left: "World and displays", right: "Selection, views and tools" };

export function SidePanel({ shell, side }: SidePanelProps): JSX.Element {
  const { layout } = shell;
  const pages = sidePages(shell, side);
  const page = pages.find(({ id }) => id === layout[side].page.value) ?? pages[0];
  const Content = page?.component;
  if (layout.isRail(side)) return <Rail shell={shell} side={side} />;
  return (
    <aside class={`panel ${side}`} aria-label={LABELS[side]}>
      <div class="tabs">
        <Tabs
          label={LABELS[side]}
          items={pages}
          selected={page?.id ?? ""}
          onSelect={(id) => layout.open(id as SidePage)}
        />
        <span class="sp" />
        {side === "right" && <UndoButtons shell={shell} />}
        <Button
          icon={`collapse_${side}`}
          label="Collapse to a rail"
          small
          onClick={() => (layout[side].isOpen.value = false)}
        />
      </div>
      <section class="page" role="tabpanel" aria-label={page?.title}>
        {Content !== undefined && <Content shell={shell} />}
      </section>
      <Edge shell={shell} side={side} />
    </aside>
  );
}

function Rail({ shell, side }: SidePanelProps): JSX.Element {
  const { layout } = shell;
  return (
    <aside class={`panel rail ${side}`} aria-label={LABELS[side]}>
      <div class="railbox">
        <Button
          icon={side === "left" ? "collapse_right" : "collapse_left"}
          label="Open the panel"
          small
          onClick={() => layout.open(layout[side].page.peek())}
        />
        {sidePages(shell, side).map(({ id, title }) => (
          <button key={id} type="button" class="b v" data-tab={id} onClick={() => layout.open(id)}>
            {title}
          </button>
        ))}
      </div>
    </aside>
  );
}

/** The inner edge of a side panel: drag it, or press arrows. */
function Edge({ shell, side }: SidePanelProps): JSX.Element {
  const { layout } = shell;
  const width = layout.widthOf(side);
  const resize = (to: number): void => layout[side].resize(to);
  const outward = side === "left" ? 1 : -1;
  return (
    <div
      class="edge x"
      role="separator"
      tabIndex={0}
      aria-orientation="vertical"
      aria-label={`Width of the ${side} panel`}
      aria-valuenow={Math.round(width)}
      aria-valuemin={SIDE.min}
      aria-valuemax={SIDE.max}
      style={{ [side]: `calc(var(--gap) + var(--${side}-now))` }}
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId))
          resize((side === "left" ? event.clientX : innerWidth - event.clientX) - 12);
      }}
      onKeyDown={(event) => {
        if (event.key === "ArrowRight") resize(width + outward * 8);
        else if (event.key === "ArrowLeft") resize(width - outward * 8);
      }}
    />
  );
}

function UndoButtons({ shell }: { readonly shell: Shell }): JSX.Element {
  const { undo } = shell.page;
  const [undoes, redoes] = [undo.undoTitle.value, undo.redoTitle.value];
  return (
    <>
      <Button
        icon="undo"
        label={undoes === null ? "Undo" : `Undo: ${undoes}`}
        keys="Ctrl Z"
        small
        disabled={undoes === null}
        onClick={() => undo.undo()}
      />
      <Button
        icon="redo"
        label={redoes === null ? "Redo" : `Redo: ${redoes}`}
        keys="Ctrl Shift Z"
        small
        disabled={redoes === null}
        onClick={() => undo.redo()}
      />
    </>
  );
}
