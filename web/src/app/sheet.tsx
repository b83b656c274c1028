/** The phone's sheet: five pages, and an open lesson; closed, half and full. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import { moveGroupNamespaces } from "../page/arms";
import { Icon, type IconName } from "../theme/icons";
import type { SheetHeight } from "./layout";
import type { Shell } from "./shell";
import { sidePages } from "./side_pages";

const PAGES: readonly { readonly id: string; readonly title: string; readonly icon: IconName }[] = [
  { id: "world", title: "World", icon: "world" },
  { id: "displays", title: "Displays", icon: "layers" },
  { id: "inspector", title: "Inspector", icon: "edit" },
  { id: "plots", title: "Plots", icon: "plots" },
  { id: "log", title: "Log", icon: "log" },
];
const ARM = { id: "motion_planning", title: "Arm", icon: "joint" } as const;
const LESSON = { id: "lesson", title: "Lesson", icon: "lesson" } as const;
const ORDER: readonly SheetHeight[] = ["closed", "half", "full"];
const SWIPE = 40; // px

export function Sheet({ shell }: { readonly shell: Shell }): JSX.Element {
  const { layout } = shell;
  const height = layout.sheetHeight.value;
  const page = layout.sheetPage.value;
  const from = useSignal<number | null>(null);
  const step = (by: number): void => {
    layout.sheetHeight.value = ORDER[Math.max(0, Math.min(2, ORDER.indexOf(height) + by))] ?? "closed";
  };
  const choose = (id: string): void => {
    if (page === id && height !== "closed") layout.sheetHeight.value = "closed";
    else layout.openSheet(id);
  };
  return (
    <section class={`sheet panel ${height}`} aria-label="Pages">
      <button
        type="button"
        class="grab"
        aria-label={height === "full" ? "Make the sheet smaller" : "Make the sheet larger"}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          from.value = event.clientY;
        }}
        onPointerUp={(event) => {
          const moved = event.clientY - (from.value ?? event.clientY);
          from.value = null;
          if (Math.abs(moved) > SWIPE) step(moved < 0 ? 1 : -1);
          else if (height === "full") layout.sheetHeight.value = "closed";
          else step(1);
        }}
        onKeyDown={(event) => {
          if (event.key === "Enter" || event.key === " " || event.key === "ArrowUp") step(1);
          else if (event.key === "ArrowDown") step(-1);
        }}
      />
      <nav aria-label="Pages of the sheet">
        {pagesOf(shell).map(({ id, title, icon }) => (
          <button
            key={id}
            type="button"
            data-tab={id}
            class={page === id && height !== "closed" ? "b on" : "b"}
            aria-pressed={page === id}
            onClick={() => choose(id)}
          >
            <Icon name={icon} />
            {title}
          </button>
        ))}
      </nav>
      {height !== "closed" && (
        <div class="page">
          <SheetPage shell={shell} page={page} />
        </div>
      )}
    </section>
  );
}

/** Pages that are offered: that of an arm where move_group runs, that of a lesson where one is open. */
function pagesOf({ page, lessons }: Shell): typeof PAGES {
  const arm = moveGroupNamespaces(page.connection).length > 0 ? [ARM] : [];
  return [...PAGES, ...arm, ...(lessons.isShown.value ? [LESSON] : [])];
}

function SheetPage({ shell, page }: { readonly shell: Shell; readonly page: string }): JSX.Element | null {
  const right = shell.layout.right.page.value;
  const pageId = page !== "inspector" ? page : right === "lesson" ? "inspector" : right;
  const Side = [...sidePages(shell, "left"), ...sidePages(shell, "right")].find(({ id }) => id === pageId)?.component;
  if (Side !== undefined) return <Side shell={shell} />;
  const panel = shell.dock.panels.value.find(({ id }) => id === page);
  if (panel === undefined) return null;
  const { component: Component, actions: Actions } = panel;
  return (
    <>
      {Actions !== undefined && (
        <div class="sheetactions">
          <Actions page={shell.page} />
        </div>
      )}
      <Component page={shell.page} />
    </>
  );
}
