/** The page's parts, as its components and panels get them. */

import type { ReadonlySignal, Signal } from "@preact/signals";

import type { PageSession, People } from "../protocol/generated/page_messages";
import type { DisplayList } from "../displays/display_list";
import type { UndoStack } from "../displays/undo_stack";
import type { PartPath } from "../scene/draft";
import type { FrameTree } from "../frames/frame_tree";
import type { Connection } from "../protocol/connection";
import type { SceneView } from "../scene/scene_view";
import type { SimulatedWorld } from "../scene/simulated_world";
import type { Views } from "../scene/view_controller";
import type { ToolBox } from "./tool";
import type { Drive } from "./drive";
import type { GoalQueue } from "./goal_queue";

interface SelectedSensor {
  readonly kind: "sensor";
  readonly model: string;
  readonly link: string;
  readonly sensor: string;
}

/** Owner of a plugin. */
export type PluginOwner =
  | { readonly kind: "world" }
  | { readonly kind: "model"; readonly model: string }
  | SelectedSensor;

/** Selection in tree or scene. */
export type Selection =
  | { readonly kind: "model"; readonly model: string }
  | { readonly kind: "link"; readonly model: string; readonly link: string }
  | { readonly kind: "joint"; readonly model: string; readonly joint: string }
  | SelectedSensor
  | { readonly kind: "plugin"; readonly of: PluginOwner; readonly plugin: string }
  | { readonly kind: "world" }
  | { readonly kind: "light"; readonly light: string }
  | { readonly kind: "frame"; readonly frame: string }
  /** Part of the edited model. */
  | { readonly kind: "part"; readonly part: PartPath }
  /** Object that a display drew, with its fields. */
  | { readonly kind: "picked"; readonly title: string; readonly fields: Readonly<Record<string, unknown>> };

/** An entry of the palette (Ctrl K) and of the help (?). */
export interface Command {
  readonly id: string;
  readonly title: string;
  readonly group: "Simulation" | "View" | "Displays" | "Tools" | "Panels" | "Page";
  /** Keys, as `Space` or `Shift R`; never a shortcut of the browser. */
  readonly keys?: string;
  readonly enabled?: () => boolean;
  readonly run: () => void;
}

export interface Commands {
  readonly all: ReadonlySignal<readonly Command[]>;
  /** Add commands; returns a function that removes them. */
  add(...commands: readonly Command[]): () => void;
}

/** Undo stack of the page. */
export interface PageUndo extends UndoStack {
  /** Use another stack while it is not null. */
  defer(other: ReadonlySignal<DeferredUndo | null>): void;
  /** Record an edit once it is done; undo and redo wait until then. */
  ask<T>(edit: Promise<T>): Promise<T>;
}

/** Undo stack that is kept elsewhere, for example by the server. */
export interface DeferredUndo {
  readonly undoTitle: string | null;
  readonly redoTitle: string | null;
  undo(): void;
  redo(): void;
}

export interface Page {
  /** Current session; effects and components that read it follow its changes. */
  readonly session: PageSession;
  readonly connection: Connection;
  readonly frames: FrameTree;
  readonly scene: SceneView;
  readonly views: Views;
  readonly world: SimulatedWorld;
  readonly displays: DisplayList;
  readonly tools: ToolBox;
  readonly selection: Signal<Selection | null>;
  readonly hovered: Signal<Selection | null>;
  readonly commands: Commands;
  readonly undo: PageUndo;
  readonly drive: Drive;
  readonly goals: GoalQueue;
  readonly theme: Signal<"light" | "dark">;
  /** People at this page. */
  readonly people: ReadonlySignal<People>;
}
