/** The drive disc: drag it and the robot goes; let go and it stops. */

import type { JSX, TargetedPointerEvent } from "preact";

import { fixed } from "../../theme/format";
import type { Drive } from "../../page/drive";

const REACH = 32; // of the knob, in the drawing's units; the drawing is 112 wide
const SOURCE = "disc";

export function DriveDisc({ drive }: { readonly drive: Drive }): JSX.Element {
  const command = drive.command.value;
  const x = command === null ? 0 : -(command.angular / drive.angularLimit.value) * REACH;
  const y = command === null ? 0 : -(command.linear / drive.linearLimit.value) * REACH;
  const reach = Math.max(1, Math.hypot(x, y) / REACH);
  const [cx, cy] = [x / reach, y / reach];
  const velocities =
    command === null ? "stopped" : `${fixed(command.linear, 2)} m/s, ${fixed(command.angular, 2)} rad/s`;
  const delay = drive.delay.value;
  const late = delay > 0 ? `${fixed(delay, 1)} s late` : "";
  const drag = (event: TargetedPointerEvent<SVGSVGElement>): void => {
    const box = event.currentTarget.getBoundingClientRect();
    const scale = 112 / box.width / REACH;
    const right = (event.clientX - box.left - box.width / 2) * scale;
    const down = (event.clientY - box.top - box.height / 2) * scale;
    const length = Math.max(1, Math.hypot(right, down));
    drive.hold(SOURCE, -down / length, -right / length);
  };
  const release = (): void => drive.release(SOURCE);
  return (
    <svg
      class="disc"
      viewBox="-56 -56 112 112"
      role="application"
      aria-label={`Drive: drag, or hold W A S D; ${velocities}${late && `, ${late}`}`}
      tabindex={0}
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        drag(event);
      }}
      onPointerMove={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) drag(event);
      }}
      onPointerUp={release}
      onPointerCancel={release}
      onLostPointerCapture={release}
      onContextMenu={(event) => event.preventDefault()}
    >
      <circle r="54" class="face" />
      {command === null ? <circle r="50" class="ring rest" /> : <circle r="50" class={late ? "ring late" : "ring"} />}
      <circle r="36" class="well" />
      <path d="M0-34V34M-34 0H34" class="cross" />
      <path d="M0-43l4 5h-8zM0 43l4-5h-8zM-43 0l5-4v8zM43 0l-5-4v8z" class="arrows" />
      {command !== null && <path d={`M0 0L${cx} ${cy}`} class="arm" />}
      <circle cx={cx} cy={cy} r="15" class={command === null ? "knob rest" : "knob"} />
      {late && (
        <text class="delay" y={cy > 0 ? -14 : 24}>
          {late}
        </text>
      )}
    </svg>
  );
}
