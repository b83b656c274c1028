/** The whole page: the scene, and everything that lies over it. */

import { useSignalEffect } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";

import { Tooltips } from "../theme/tooltips";
import { Bar } from "./bar";
import { Dialogs } from "./dialogs/dialogs";
import { Rings } from "./lessons/marks";
import { PaneFrames } from "./panes/pane_frames";
import type { Shell } from "./shell";
import { Sheet } from "./sheet";
import { SidePanel } from "./side_panel";
import { SceneOverlay } from "./scene_overlay";

export function App({ shell }: { readonly shell: Shell }): JSX.Element {
  const phone = shell.layout.isPhone.value;
  return (
    <>
      <Scene shell={shell} />
      <Bar shell={shell} />
      <SceneOverlay shell={shell} />
      {!phone && <SidePanel shell={shell} side="left" />}
      {!phone && <SidePanel shell={shell} side="right" />}
      {!phone && <DockPanel shell={shell} />}
      {phone && <Sheet shell={shell} />}
      <Rings shell={shell} />
      <Dialogs shell={shell} />
      <Tooltips />
    </>
  );
}

function Scene({ shell }: { readonly shell: Shell }): JSX.Element {
  const host = useRef<HTMLElement>(null);
  const { scene, connection } = shell.page;
  useEffect(() => host.current?.replaceChildren(shell.sceneHost), [shell]);
  useSignalEffect(() => {
    scene.freeArea.value = shell.insets.value;
  });
  const lost = connection.state.value.kind === "lost";
  const isDrawn = shell.isDrawn.value;
  return (
    <>
      <main ref={host} class={`scene${lost ? " lost" : ""}${isDrawn ? "" : " none"}`} aria-label="3D scene" />
      {isDrawn && <PaneFrames shell={shell} />}
    </>
  );
}

function DockPanel({ shell }: { readonly shell: Shell }): JSX.Element {
  const { layout } = shell;
  const host = useRef<HTMLDivElement>(null);
  const dock = shell.dock.dock.value;
  useEffect(() => (host.current === null || dock === null ? undefined : shell.dock.mount(dock, host.current)), [dock]);
  const height = layout.dock.value;
  const open = layout.dockOpen.value;
  return (
    <section class={open ? "panel dock" : "panel dock shut"} aria-label="Dock">
      <div ref={host} class="dockhost" />
      <div
        class="edge y"
        role="separator"
        tabIndex={0}
        aria-orientation="horizontal"
        aria-label="Height of the dock"
        aria-valuenow={Math.round(height)}
        aria-valuemin={32}
        aria-valuemax={Math.round(layout.height.value / 2)}
        style={{ bottom: `${height + 8}px` }}
        onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
        onPointerMove={(event) => {
          if (event.currentTarget.hasPointerCapture(event.pointerId))
            layout.resizeDock(innerHeight - event.clientY - 12);
        }}
        onKeyDown={(event) => {
          if (event.key === "ArrowUp") layout.resizeDock(height + 16);
          else if (event.key === "ArrowDown") layout.resizeDock(height - 16);
        }}
      />
    </section>
  );
}
