/** The place of the dock, which is loaded with its panels after the page's first picture. */

import { signal } from "@preact/signals";

import type { Panel } from "../panels/panel";
import type { Dock } from "./dock";
import type { Layout } from "./layout";
import type { Page } from "../page/page";

export class DockSlot {
  /** Available panels; empty before they are loaded. */
  readonly panels = signal<readonly Panel[]>([]);
  /** Dock; null before it is loaded. */
  readonly dock = signal<Dock | null>(null);
  /** Panel that was requested before the dock was loaded. */
  private pendingPanel: string | null = null;

  constructor(
    private readonly page: Page,
    private readonly layout: Layout,
  ) {}

  /** Load the dock once there are panels. */
  async load(coming: Promise<readonly Panel[]>): Promise<void> {
    const panels = await coming;
    const { Dock } = await import("./dock");
    this.dock.value = new Dock(this.page, panels, this.layout);
    this.panels.value = panels;
  }

  /** Fill an element with the loaded dock; returns a function that empties it. */
  mount(dock: Dock, element: HTMLElement): () => void {
    const unmount = dock.mount(element);
    if (this.pendingPanel !== null) dock.show(this.pendingPanel);
    this.pendingPanel = null;
    return unmount;
  }

  /** Bring a panel to the front; opens it if it is closed. */
  open(id: string): void {
    this.layout.openDock(true);
    if (this.layout.isPhone.peek()) this.layout.openSheet(id);
    const dock = this.dock.peek();
    if (dock === null) this.pendingPanel = id;
    else dock.show(id);
  }
}
