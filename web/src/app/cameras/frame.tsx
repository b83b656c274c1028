/** The edge of a simulated camera's picture, while one looks through it. */

import type { JSX } from "preact";

import type { Shell } from "../shell";

export function CameraFrame({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const frame = shell.page.views.cameraFrame.value;
  if (frame === null) return null;
  const { left, top, width, height } = frame;
  return <div class="cameraframe" style={{ left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` }} />;
}
