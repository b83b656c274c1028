/** The dock below the scene: panels in tabs that can be split, moved and closed. */

import { effect, signal } from "@preact/signals";
import { render, type ComponentChildren, type JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import {
  createDockview,
  type DockviewApi,
  type IContentRenderer,
  type IHeaderActionsRenderer,
  type ITabRenderer,
  type SerializedDockview,
} from "dockview-core";

import type { PageSession } from "../protocol/generated/page_messages";
import type { Panel } from "../panels/panel";
import { Button } from "../theme/button";
import { Icon } from "../theme/icons";
import { MenuButton } from "../theme/menu";
import type { Layout } from "./layout";
import { moveGroupNamespaces } from "../page/arms";
import type { Page } from "../page/page";
import { forEachNew } from "../page/session";
import { recall, remember } from "../page/storage";

/** Panels that are open by default, in this order. */
const FIRST = ["plots", "topics", "log", "graph", "timeline"] as const;

/** Height of the row of tabs, with the dock's borders [px]. */
const TABS = 34;

/** Panel that is in front by default. */
const FRONT: Readonly<Record<PageSession["kind"], string>> = {
  simulation: "plots",
  graph: "topics",
  log: "timeline",
  bag: "timeline",
};

export class Dock {
  private api: DockviewApi | null = null;
  private readonly byId: ReadonlyMap<string, Panel>;

  constructor(
    private readonly page: Page,
    panels: readonly Panel[],
    private readonly layout: Layout,
  ) {
    this.byId = new Map(panels.map((panel) => [panel.id, panel]));
  }

  /** Fill an element; returns a function that empties it. */
  mount(element: HTMLElement): () => void {
    const api = createDockview(element, {
      disableFloatingGroups: true,
      theme: { name: "trundle", className: "trundle-dock", dndPanelOverlay: "content" },
      createComponent: ({ name }) => this.content(name),
      createTabComponent: ({ name }) => this.tab(name),
      createLeftHeaderActionComponent: () => this.adder(),
      createRightHeaderActionComponent: (group) => this.actions(() => group.activePanel?.id ?? "", group.id),
    });
    this.api = api;
    this.restore(api);
    const unfollow = forEachNew(
      () => [...this.page.session.panels, ...armPrograms(this.page)],
      (program) => this.showProgram(api, program),
    );
    const saved = api.onDidLayoutChange(() => remember(this.key, api.toJSON()));
    const unfit = this.followContents(api);
    const tabOf = ({ target }: Event): HTMLElement | null =>
      target instanceof Element && target.closest(".tab .shut") === null
        ? target.closest<HTMLElement>(".dv-tab")
        : null;
    const keyDown = (event: KeyboardEvent): void => {
      const tab = tabOf(event);
      if (event.key === "Delete") api.getPanel(tab?.dataset["tabPanelId"] ?? "")?.api.close();
      if (event.key === "Enter" && tab !== null) this.layout.openDock(true);
    };
    const click = (event: MouseEvent): void => {
      if (tabOf(event) !== null && !this.layout.dockOpen.peek()) this.layout.openDock(true);
    };
    element.addEventListener("keydown", keyDown);
    element.addEventListener("click", click);
    return () => {
      unfollow();
      unfit();
      element.removeEventListener("keydown", keyDown);
      element.removeEventListener("click", click);
      saved.dispose();
      api.dispose();
      this.api = null;
    };
  }

  /** Tell the layout the height of the dock's contents from now on; returns a function that stops. */
  private followContents(api: DockviewApi): () => void {
    const changes = signal(0);
    const count = (): void => void (changes.value += 1);
    const changed = [api.onDidLayoutChange(count), api.onDidActivePanelChange(count)];
    const stop = effect(() => {
      changes.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- follows changes of the front panels
      const [group, other] = api.groups;
      const front = other === undefined ? this.byId.get(group?.activePanel?.id ?? "") : undefined;
      const height = front?.contentHeight?.(this.page).value ?? null;
      this.layout.dockContents.value = height === null ? null : height + TABS;
    });
    return () => {
      stop();
      for (const subscription of changed) subscription.dispose();
    };
  }

  /** Bring a panel to the front; opens it if it is closed. */
  show(id: string): void {
    this.layout.openDock(true);
    if (this.api !== null) this.add(this.api, id);
  }

  private add(api: DockviewApi, id: string, behind?: string): void {
    const panel = this.byId.get(id);
    if (panel === undefined) return;
    const open = api.getPanel(id);
    if (open !== undefined) open.api.setActive();
    else
      api.addPanel({
        id,
        component: id,
        tabComponent: id,
        title: panel.title,
        ...(behind !== undefined && { position: { referencePanel: behind }, inactive: true }),
      });
  }

  private get key(): string {
    return `dock.${this.page.session.kind}`;
  }

  private restore(api: DockviewApi): void {
    const saved = recall(this.key, null, isLayout);
    try {
      if (saved !== null && Object.keys(saved.panels).every((id) => this.byId.has(id))) api.fromJSON(saved);
    } catch {
      api.clear(); // a layout of another version
    }
    if (api.totalPanels === 0) {
      const [first, ...others] = FIRST;
      this.add(api, first);
      for (const id of others) this.add(api, id, first); // drawing every panel in front, one by one, takes long
      this.add(api, FRONT[this.page.session.kind]);
    }
  }

  /** Show the panels that replace a ROS program. */
  private showProgram(api: DockviewApi, program: string): void {
    for (const panel of this.byId.values()) if (panel.programs.includes(program)) this.add(api, panel.id);
  }

  private content(id: string): IContentRenderer {
    const element = document.createElement("div");
    element.className = "page";
    const Component = this.byId.get(id)?.component;
    return {
      element,
      init: () => {
        if (Component !== undefined) render(<Component page={this.page} />, element);
      },
      dispose: () => render(null, element),
    };
  }

  private tab(id: string): ITabRenderer {
    const element = document.createElement("div");
    element.className = "tab";
    const title = this.byId.get(id)?.title ?? id;
    return {
      element,
      init: ({ api }) => {
        render(
          <>
            {title}
            <span
              class="shut"
              data-tip={`Close ${title} (Delete)`}
              onPointerDown={(event) => event.stopPropagation()}
              onClick={() => api.close()}
            >
              <Icon name="close" />
            </span>
          </>,
          element,
        );
      },
      dispose: () => render(null, element),
    };
  }

  private adder(): IHeaderActionsRenderer {
    const element = document.createElement("div");
    const items = (): { title: string; run: () => void }[] =>
      [...this.byId.values()]
        .filter((panel) => this.api?.getPanel(panel.id) === undefined)
        .map((panel) => ({ title: panel.title, run: () => this.show(panel.id) }));
    return {
      element,
      init: () => render(<MenuButton icon="plus" label="Open a panel" class="sml" items={items} />, element),
      dispose: () => render(null, element),
    };
  }

  private actions(active: () => string, group: string): IHeaderActionsRenderer {
    const element = document.createElement("div");
    element.className = "grp";
    const draw = (): void => {
      const Actions = this.byId.get(active())?.actions;
      const isLast = this.api?.groups.at(-1)?.id === group || this.api === null;
      render(
        <>
          {Actions !== undefined && (
            <PanelActions key={active()}>
              <Actions page={this.page} />
            </PanelActions>
          )}
          {isLast && <Collapse layout={this.layout} />}
        </>,
        element,
      );
    };
    const listening: { dispose(): void }[] = [];
    return {
      element,
      init: ({ api, containerApi }) => {
        draw();
        listening.push(api.onDidActivePanelChange(draw), containerApi.onDidLayoutChange(draw));
      },
      dispose: () => {
        for (const subscription of listening) subscription.dispose();
        render(null, element);
      },
    };
  }
}

/** Controls of a panel: in the row of tabs, or, where that is narrow, below a button. */
function PanelActions({ children }: { readonly children: ComponentChildren }): JSX.Element {
  const [isOpen, setOpen] = useState(false);
  const root = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const outside = ({ target }: PointerEvent): void => {
      if (target instanceof Node && root.current?.contains(target) !== true) setOpen(false);
    };
    addEventListener("pointerdown", outside, true);
    return () => removeEventListener("pointerdown", outside, true);
  }, []);
  return (
    <div ref={root} class="actions" onKeyDown={({ key }) => key === "Escape" && setOpen(false)}>
      <div class={isOpen ? "acts open" : "acts"}>{children}</div>
      <Button
        icon="dots"
        label="Controls of the panel"
        class="unfold"
        small
        on={isOpen}
        onClick={() => setOpen(!isOpen)}
      />
    </div>
  );
}

function Collapse({ layout }: { readonly layout: Layout }): JSX.Element {
  const open = layout.dockOpen.value;
  const label = open ? "Collapse the dock" : "Open the dock";
  return (
    <Button icon={open ? "collapse_down" : "expand_up"} label={label} small onClick={() => layout.openDock(!open)} />
  );
}

/** move_group, where it runs: its panel is opened as that of a program of the launch. */
function armPrograms({ connection }: Page): readonly string[] {
  return moveGroupNamespaces(connection).length > 0 ? ["move_group"] : [];
}

function isLayout(value: unknown): value is SerializedDockview | null {
  return (
    value === null ||
    (typeof value === "object" && "panels" in value && typeof value.panels === "object" && "grid" in value)
  );
}
