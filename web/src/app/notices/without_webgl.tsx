/** A browser without WebGL: the reason, and pictures of a simulated world by our own renderer, which a drag turns. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";

import { isBoolean, recall, remember } from "../../page/storage";
import { pictureUrl } from "../../protocol/picture_urls";
import { Button } from "../../theme/button";
import { fixed } from "../../theme/format";
import type { Shell } from "../shell";

/** Pause after a loaded picture, and after a failed one [ms]. */
const REFRESH = { loaded: 500, failed: 3000 };
/** Largest requested picture [px]. */
const [MAX_WIDTH, MAX_HEIGHT] = [960, 720];
const TURN = 0.01; // rad per pixel

interface WithoutWebGlProps {
  readonly shell: Shell;
  readonly reason: string;
}

export function WithoutWebGl({ shell, reason }: WithoutWebGlProps): JSX.Element {
  const isClosed = useSignal(recall("without_webgl.closed", false, isBoolean));
  const { kind } = shell.page.session;
  const hasPictures = kind === "simulation" || kind === "log"; // the server draws no graphs and no bags
  const close = (): void => {
    isClosed.value = true;
    remember("without_webgl.closed", true);
  };
  return (
    <>
      {hasPictures && <Pictures shell={shell} />}
      {!isClosed.value && (
        <div class={hasPictures ? "scene-note high float" : "scene-note float"} role="status">
          <p>
            {reason}
            {hasPictures && " These pictures come from the simulator's own renderer: drag to turn."}
          </p>
          <Button icon="close" label="Dismiss" small onClick={close} />
        </div>
      )}
    </>
  );
}

function Pictures({ shell }: { readonly shell: Shell }): JSX.Element {
  const view = useSignal({ azimuth: 0.8, elevation: 0.5, distance: 4 });
  const shown = useSignal("");
  const failed = useSignal(false);
  const timer = useRef(0);
  const { width, height } = shell.layout;
  const ask = (): void => {
    if (document.visibilityState !== "visible") {
      askIn(REFRESH.loaded);
      return;
    }
    const share = Math.min(1, MAX_WIDTH / width.peek(), MAX_HEIGHT / height.peek());
    // as wide and high as the window: nothing is cut off
    const size = { width: Math.round(share * width.peek()), height: Math.round(share * height.peek()) };
    shown.value = pictureUrl("camera.png", { ...size, ...view.peek() }, performance.now());
  };
  /** Request the next picture after a pause; never two at once, which a slow machine would not finish. */
  const askIn = (wait: number): void => {
    timer.current = window.setTimeout(ask, wait);
  };
  useEffect(() => {
    ask();
    return () => clearTimeout(timer.current);
  }, [shell]);
  const answered = (hasFailed: boolean): void => {
    failed.value = hasFailed;
    askIn(hasFailed ? REFRESH.failed : REFRESH.loaded);
  };
  const turn = (dx: number, dy: number): void => {
    const { azimuth, elevation, distance } = view.peek();
    view.value = {
      azimuth: azimuth - dx * TURN,
      elevation: Math.min(1.5, Math.max(-0.2, elevation + dy * TURN)),
      distance,
    };
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
      {shown.value !== "" && (
        <img
          class="pictures"
          hidden={failed.value}
          src={shown.value}
          alt={`The world, from ${fixed(view.value.distance, 1)} m`}
          tabIndex={0}
          draggable={false}
          onLoad={() => answered(false)}
          onError={() => answered(true)}
          onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
          onPointerMove={(event) =>
            event.currentTarget.hasPointerCapture(event.pointerId) && turn(event.movementX, event.movementY)
          }
          onWheel={(event) => zoom(event.deltaY > 0 ? 1.15 : 1 / 1.15)}
          onKeyDown={(event) => keys[event.key]?.()}
        />
      )}
      {failed.value && <p class="scene-note float">The simulator sends no picture. The page asks again.</p>}
    </>
  );
}
