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
  /** Programs of ROS whose node opens it: `rqt_plot`. */
  readonly programs: readonly string[];
  readonly component: ComponentType<PanelProps>;
  /** Buttons at the right of the dock's row of tabs. */
  readonly actions?: ComponentType<PanelProps>;
  /** Height of its contents [px], null before they are shown; absent: it fills the height that it gets. */
  readonly contentHeight?: (page: Page) => ReadonlySignal<number | null>;
}
