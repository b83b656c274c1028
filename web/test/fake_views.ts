/** Views that note what they frame, and draw nothing. */

import { signal } from "@preact/signals";
import type { Box3 } from "three";

import type { PaneLayout } from "../src/scene/panes/pane_layout";
import type { ViewController, ViewPane, Views } from "../src/scene/view_controller";

export class FakeViews implements Views {
  readonly current = signal(fakeView("rviz/Orbit"));
  readonly classes = ["rviz/Orbit", "rviz/XYOrbit", "rviz/TopDownOrtho", "rviz/FPS", "rviz/ThirdPersonFollower"];
  readonly saved = signal<readonly ViewController[]>([]);
  readonly framed: Box3[] = [];
  readonly layout = signal<PaneLayout>("one");
  readonly pane = fakePane(this.current, this.framed);
  readonly active = signal<ViewPane>(this.pane);
  readonly panes = signal<readonly ViewPane[]>([this.pane]);
  /** Show one more pane. */
  addPane(): FakePane {
    const pane = fakePane(signal(fakeView("rviz/Orbit")), this.framed);
    this.panes.value = [...this.panes.value, pane];
    return pane;
  }
  onFileLayout: (layout: PaneLayout) => void = (layout) => {
    this.layout.value = layout;
  };
  activate(pane: ViewPane): void {
    this.active.value = pane;
  }
  stepPane(): void {
    // there is one
  }
  use(className: string): void {
    this.current.value = fakeView(className);
  }
  useSaved(view: ViewController): void {
    this.current.value = view;
  }
  copyCurrent(name: string): ViewController {
    return { ...this.current.value, name: signal(name), save: () => ({ Name: name }) };
  }
  frame(box: Box3): void {
    this.framed.push(box);
  }
  focus(): void {
    // nothing is drawn
  }
  lookFrom(): void {
    // nothing is drawn
  }
  toggleProjection(): void {
    // nothing is drawn
  }
  lookThrough(): void {
    // nothing is drawn
  }
  ride(): void {
    // nothing is drawn
  }
  follow(_target: string | null): void {
    // nothing is drawn
  }
  save(): Record<string, never> {
    return {};
  }
  load(): string[] {
    return [];
  }
}

type FakePane = ReturnType<typeof fakePane>;

/** A pane with a view; `framed` receives what it frames. */
export function fakePane(current: ViewPane["current"], framed: Box3[] = []) {
  const place = { area: { left: 0, top: 0, width: 1, height: 1 }, insets: { left: 0, right: 0, top: 0, bottom: 0 } };
  return {
    current,
    place: signal(place),
    free: signal({ left: 0, top: 0, width: 1, height: 1 }),
    isChosen: signal(false),
    frameFirst: (box) => void framed.push(box.clone()),
    cameraFrame: signal(null),
    load: (yaml) => current.peek().load(yaml),
  } satisfies ViewPane;
}

function fakeView(className: string): ViewController {
  return { className, name: signal(""), properties: [], save: () => ({}), load: () => [] };
}
