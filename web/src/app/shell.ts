/** State that the page's components share: the page, and its open parts. */

import { computed, effect, signal, type Signal } from "@preact/signals";

import type { Display } from "../displays/display";
import type { Fields, RequestName } from "../protocol/connection";
import { ModelEditor } from "./editor/model_editor";
import type { PaneLayout } from "../scene/panes/pane_layout";
import { cameraTopics } from "./cameras/topics";
import { CommandList } from "./commands";
import type { OpenDialog } from "./dialogs/open_dialog";
import { DockSlot } from "./dock_slot";
import { Insertion } from "./insert/insertion";
import { Layout } from "./layout";
import { Lessons } from "./lessons/lessons";
import { Notices } from "./notices/notices";
import type { OpenMenu } from "./object_menu/open_menu";
import { moveGroupNamespaces } from "../page/arms";
import type { Page, Selection } from "../page/page";
import { recallSplit } from "./panes/remembered_split";
import { isBoolean, recall, remember } from "../page/storage";
import { keyOf } from "../page/world_nodes";
import { Videos } from "./video/videos";

/** An .rviz file that is shown. */
export interface RvizFileInfo {
  readonly name: string;
  /** False: it can only be downloaded or saved as another one. */
  readonly writable: boolean;
}

export class Shell {
  readonly layout: Layout;
  readonly notices: Notices;
  readonly dock: DockSlot;
  readonly dialog = signal<OpenDialog>(null);
  /** Split of the scene on wide pages. */
  readonly split: Signal<PaneLayout>;
  /** Open menu of an object in the scene or tree; null: none. */
  readonly menu = signal<OpenMenu | null>(null);
  /** Name of the model that Paste copies. */
  readonly copied = signal<string | null>(null);
  /** Link whose force form is to take the focus; null once it has the focus. */
  readonly wrench = signal<{ readonly model: string; readonly link: string } | null>(null);
  /** The display that is selected in its panel. */
  readonly display = signal<Display | null>(null);
  /** The .rviz file that the person opened or saved in place of the session's; null: none. */
  readonly openedFile = signal<RvizFileInfo | null>(null);
  readonly showsCameras = signal(recall("cameras", true, isBoolean));
  /** False: the browser has no WebGL, and controls of the 3D view are not offered. */
  readonly isDrawn = computed(() => this.page.scene.status.value.kind !== "unsupported");
  /** Name of the robot: the session's, else that of the robot description. */
  readonly robot = computed(() => {
    const { session, connection } = this.page;
    if (session.robot !== null || session.kind !== "graph") return session.robot;
    const text = connection.parameters.value.get("/robot_description");
    return typeof text === "string" ? (/<robot\b[^>]*?\bname\s*=\s*["']([^"']+)["']/.exec(text)?.[1] ?? null) : null;
  });
  /** Cameras that have a tile. */
  readonly cameras = computed(() => {
    const { session, world, displays } = this.page;
    return this.showsCameras.value ? cameraTopics(session, world.manifest.value, displays.displays.value) : [];
  });
  /** Edges of the scene that panels, tiles and the disc cover [px]; the view is centered in the rest. */
  readonly insets = computed(() =>
    this.layout.insets({ tiles: this.cameras.value.length > 0, drive: this.page.drive.topic.value !== null }),
  );
  /** Topics of enlarged cameras. */
  readonly enlarged = signal<ReadonlySet<string>>(new Set());
  /** Open state of rows of the Displays page. */
  readonly openDisplays = signal<ReadonlyMap<string, boolean>>(new Map());

  readonly insertion: Insertion;
  readonly videos: Videos;
  readonly editor: ModelEditor;
  readonly lessons: Lessons;

  constructor(
    readonly page: Page,
    readonly commands: CommandList,
    /** Element that holds the scene's canvas. */
    readonly sceneHost: HTMLElement,
    /** True while messages are held back. */
    readonly frozen: Signal<boolean>,
  ) {
    this.layout = new Layout(page.session.kind);
    this.split = recallSplit(page, this.layout);
    this.notices = new Notices(page);
    this.insertion = new Insertion(this);
    this.videos = new Videos(page, this.notices);
    this.editor = new ModelEditor(page, this.notices);
    this.dock = new DockSlot(page, this.layout);
    this.lessons = new Lessons(this);
    effect(() => remember("cameras", this.showsCameras.value));
    effect(() => {
      if (this.fillsDock()) this.layout.dockBegins.value = true; // stays true when the robot's driver ends
    });
  }

  /** True if the dock has something to show at first: a robot's motion, an arm that plans, plots, panels of programs, a recording. */
  private fillsDock(): boolean {
    const { session, drive, connection } = this.page;
    if (moveGroupNamespaces(connection).length > 0) return true;
    const isRecorded = session.kind === "log" || session.kind === "bag";
    return isRecorded || drive.topic.value !== null || session.plots.length > 0 || session.panels.length > 0;
  }

  /** Select what was clicked in the scene, and show it in the tree of the left panel if that is open. */
  select(selection: Selection | null): void {
    this.page.selection.value = selection;
    const isInTree = keyOf(selection) !== "" || selection?.kind === "part";
    if (isInTree && !this.layout.isRail("left")) this.layout.left.page.value = "world";
  }

  /** Send a request to the server; a refusal becomes a notice. */
  request<N extends RequestName>(title: string, name: N, fields: Fields<N>): void {
    this.page.connection.request(name, fields).catch((error: unknown) => {
      this.notices.report(title, error instanceof Error ? error.message : String(error));
    });
  }
}
