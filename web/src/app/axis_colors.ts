/** Colors of axes: the theme's colors, or rviz's colors in displays of a page that looks like rviz. */

import { effect, type ReadonlySignal, type Signal } from "@preact/signals";
import { Color } from "three";

import type { Page } from "../page/page";
import type { Rgb } from "../rviz/properties";
import { setAxisColors } from "../scene/overlays/overlay_shapes";
import { AXIS_RGB, type AxisColors } from "../shapes/axes";

/** Set the colors of displays' axes and of overlays whenever the theme or the session changes. */
export function followAxisColors(page: Page, theme: ReadonlySignal<string>, ofDisplays: Signal<AxisColors>): void {
  effect(() => {
    const { kind, rviz } = page.session;
    const isOwnLook = rviz === null && (kind === "simulation" || kind === "log");
    document.documentElement.dataset["theme"] = theme.value; // the theme's own effect may run later
    const colors = designColors();
    setAxisColors(colors);
    ofDisplays.value = isOwnLook ? colors : AXIS_RGB;
    page.scene.invalidate();
  });
}

function designColors(): AxisColors {
  const style = getComputedStyle(document.documentElement);
  const rgb = (token: string): Rgb => {
    const hex = new Color(style.getPropertyValue(token).trim()).getHex();
    return [hex >> 16, (hex >> 8) & 255, hex & 255];
  };
  return [rgb("--x"), rgb("--y"), rgb("--z")];
}
