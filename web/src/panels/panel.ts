/** Panels of the dock. */

import type { ReadonlySignal } from "@preact/signals";
import type { ComponentType } from "preact";

import type { Page } from "../page/page";

export interface PanelProps {
  readonly page: Page;
}

/** A panel of the dock: each file in this folder exports one. */
export interface Panel {
  readonly id: string;
  readonly title: string;
  /** ROS programs whose node in a launch opens the panel: `rqt_plot`. */
  readonly programs: readonly string[];
  readonly component: ComponentType<PanelProps>;
  /** Buttons at the right of the dock's row of tabs. */
  readonly actions?: ComponentType<PanelProps>;
  /** Height of the contents [px], null before they are shown; absent: the panel fills any height. */
  readonly contentHeight?: (page: Page) => ReadonlySignal<number | null>;
}
