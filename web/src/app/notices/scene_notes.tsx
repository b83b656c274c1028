/** What stands in place of the scene or over it: loading, an empty world, a browser without WebGL. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect } from "preact/hooks";

import { fixed } from "../../theme/format";
import type { Shell } from "../shell";

export function SceneNotes({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const status = shell.page.scene.status.value;
  if (status.kind === "unsupported") return <Pictures shell={shell} reason={status.reason} />;
  if (status.kind === "lost") return <Note text="The graphics card was taken away; the browser will give it back, or load the page again." />;
  return <Loading shell={shell} />;
}

function Note({ text }: { readonly text: string }): JSX.Element {
  return (
    <p class="scene-note float" role="status">
      {text}
    </p>
  );
}

function Loading({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const { world, session, connection } = shell.page;
  const manifest = world.manifest.value;
  const progress = world.progress.value;
  if (session.kind === "graph" || session.kind === "bag" || connection.state.value.kind !== "connected") return null;
  if (manifest === null) return <Note text="Waiting for the world." />;
  if (manifest.models.length === 0) return <Note text="The world is empty." />;
  if (progress >= 1) return null;
  const percent = fixed(progress * 100, 0);
  return (
    <div class="scene-note float">
      <span>Loading {manifest.name}</span>
      <span class="t2">{percent} %</span>
      <progress aria-label="Loading the world" value={progress} />
    </div>
  );
}

const REFRESH = 500; // ms
/** Largest picture that is asked for [px]. */
const [MOST_WIDE, MOST_HIGH] = [960, 720];
const TURN = 0.01; // rad per pixel

/** Pictures by our own renderer, turned by a drag. */
function Pictures({ shell, reason }: { readonly shell: Shell; readonly reason: string }): JSX.Element {
  const view = useSignal({ azimuth: 0.8, elevation: 0.5, distance: 4 });
  const shown = useSignal("");
  const failed = useSignal(false);
  const { isPhone, width, height } = shell.layout;
  useEffect(() => {
    const ask = (): void => {
      const { azimuth, elevation, distance } = view.peek();
      const share = Math.min(1, MOST_WIDE / width.peek(), MOST_HIGH / height.peek());
      const [w, h] = [Math.round(share * width.peek()), Math.round(share * height.peek())]; // as wide and high as the window: nothing is cut off
      shown.value = `camera.png?width=${w}&height=${h}&azimuth=${azimuth}&elevation=${elevation}&distance=${distance}&t=${performance.now()}`;
    };
    ask();
    const timer = setInterval(() => !failed.peek() && document.visibilityState === "visible" && ask(), REFRESH);
    return () => clearInterval(timer);
  }, [shell]);
  const turn = (dx: number, dy: number): void => {
    const { azimuth, elevation, distance } = view.peek();
    view.value = { azimuth: azimuth - dx * TURN, elevation: Math.min(1.5, Math.max(-0.2, elevation + dy * TURN)), distance };
  };
  const zoom = (factor: number): void => {
    view.value = { ...view.peek(), distance: Math.min(100, Math.max(0.3, view.peek().distance * factor)) };
  };
  const keys: Readonly<Record<string, () => void>> = {
    ArrowLeft: () => turn(-20, 0),
    ArrowRight: () => turn(20, 0),
    ArrowUp: () => turn(0, 20),
    ArrowDown: () => turn(0, -20),
    "+": () => zoom(0.85),
    "-": () => zoom(1 / 0.85),
  };
  return (
    <>
      {shown.value !== "" && !failed.value && (
        <img
          class="pictures"
          src={shown.value}
          alt={`The world, from ${fixed(view.value.distance, 1)} m`}
          tabIndex={0}
          draggable={false}
          onError={() => (failed.value = true)}
          onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
          onPointerMove={(event) => event.currentTarget.hasPointerCapture(event.pointerId) && turn(event.movementX, event.movementY)}
          onWheel={(event) => zoom(event.deltaY > 0 ? 1.15 : 1 / 1.15)}
          onKeyDown={(event) => keys[event.key]?.()}
        />
      )}
      <p class={isPhone.value || !failed.value ? "scene-note high float" : "scene-note float"} role="status">
        {reason}
        {!failed.value && " These pictures come from the simulator's own renderer: drag to turn."}
      </p>
    </>
  );
}
