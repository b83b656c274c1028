/** Frames of the panes, titles of their views with menus, and the frame of a camera's picture. */

import { computed } from "@preact/signals";
import type { JSX } from "preact";
import { useMemo } from "preact/hooks";

import type { ViewPane } from "../../scene/view_controller";
import { MenuButton } from "../../theme/menu";
import type { Shell } from "../shell";
import { paneItems } from "./pane_items";
import { paneTitle } from "./pane_title";

export function PaneFrames({ shell }: { readonly shell: Shell }): JSX.Element {
  const panes = shell.page.views.panes.value;
  return (
    <section class="panes" aria-label="Views">
      {panes.map((pane, index) => (
        <PaneFrame key={index} shell={shell} pane={pane} isSplit={panes.length > 1} />
      ))}
    </section>
  );
}

interface PaneProps {
  readonly shell: Shell;
  readonly pane: ViewPane;
  readonly isSplit: boolean;
}

function PaneFrame({ shell, pane, isSplit }: PaneProps): JSX.Element {
  const { left, top, width, height } = pane.place.value.area;
  const isActive = shell.page.views.active.value === pane;
  const kind = !isSplit ? "pane" : isActive ? "pane split on" : "pane split";
  return (
    <div class={kind} style={{ left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` }}>
      {isSplit && <PaneName shell={shell} pane={pane} isActive={isActive} />}
      <CameraFrame pane={pane} />
    </div>
  );
}

function PaneName({
  shell,
  pane,
  isActive,
}: {
  readonly shell: Shell;
  readonly pane: ViewPane;
  readonly isActive: boolean;
}): JSX.Element {
  const title = useMemo(() => computed(() => paneTitle(pane.current.value)), [pane]).value; // computed: drawn again only if the text changes
  const { left, top } = pane.place.value.insets;
  return (
    <div class={isActive ? "panename on" : "panename"} style={{ left: `${left + 8}px`, top: `${top + 8}px` }}>
      <MenuButton class="sml" items={() => paneItems(shell, pane)}>
        {title}
      </MenuButton>
    </div>
  );
}

/** Frame of a simulated camera's picture, while looking through it. */
function CameraFrame({ pane }: { readonly pane: ViewPane }): JSX.Element | null {
  const frame = pane.cameraFrame.value;
  if (frame === null) return null;
  const { left, top, width, height } = frame;
  return (
    <div
      class="cameraframe"
      style={{ left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` }}
    />
  );
}
