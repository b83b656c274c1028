/** The part of the canvas that no panel covers. */

import type { OrthographicCamera, PerspectiveCamera } from "three";

/** Widths of the canvas' edges that panels cover [px]. */
export interface Insets {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

export interface Area {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

export const NO_INSETS: Insets = { left: 0, right: 0, top: 0, bottom: 0 };

/** The free rectangle [px], at least one pixel. */
export function freeArea(width: number, height: number, insets: Insets): Area {
  return {
    left: insets.left,
    top: insets.top,
    width: Math.max(1, width - insets.left - insets.right),
    height: Math.max(1, height - insets.top - insets.bottom),
  };
}

/** Shift a camera's picture so that its axis meets the middle of the free area. */
export function centreOn(
  area: Area,
  camera: PerspectiveCamera | OrthographicCamera,
  width: number,
  height: number,
): void {
  const x = width / 2 - (area.left + area.width / 2);
  const y = height / 2 - (area.top + area.height / 2);
  if (x === 0 && y === 0) camera.clearViewOffset();
  else camera.setViewOffset(width, height, x, y, width, height);
}
