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

interface SelectedSensor {
  readonly kind: "sensor";
  readonly model: string;
  readonly link: string;
  readonly sensor: string;
}

/** What has a plugin. */
export type PluginOwner =
  | { readonly kind: "world" }
  | { readonly kind: "model"; readonly model: string }
  | SelectedSensor;

/** What is selected, in tree or scene. */
export type Selection =
  | { readonly kind: "model"; readonly model: string }
  | { readonly kind: "link"; readonly model: string; readonly link: string }
  | { readonly kind: "joint"; readonly model: string; readonly joint: string }
  | SelectedSensor
  | { readonly kind: "plugin"; readonly of: PluginOwner; readonly plugin: string }
  | { readonly kind: "world" }
  | { readonly kind: "light"; readonly light: string }
  | { readonly kind: "frame"; readonly frame: string }
  /** Of the model that is edited. */
  | { readonly kind: "part"; readonly part: PartPath }
  /** Something that a display drew: fields of what was picked. */
  | { readonly kind: "picked"; readonly title: string; readonly fields: Readonly<Record<string, unknown>> };

/** An entry of the palette (Ctrl K) and of the help (?). */
export interface Command {
  readonly id: string;
  readonly title: string;
  readonly group: "Simulation" | "View" | "Displays" | "Tools" | "Panels" | "Page";
  /** As `Space` or `Shift R`; never one of the browser's own. */
  readonly keys?: string;
  readonly enabled?: () => boolean;
  readonly run: () => void;
}

export interface Commands {
  readonly all: ReadonlySignal<readonly Command[]>;
  /** Add commands; returns how to remove them. */
  add(...commands: readonly Command[]): () => void;
}

/** The page's own stack. */
export interface PageUndo extends UndoStack {
  /** While there is another stack, it is the one whose edits are taken back. */
  defer(other: ReadonlySignal<DeferredUndo | null>): void;
  /** An edit that is recorded once it is done; what is taken back meanwhile waits for it. */
  ask<T>(edit: Promise<T>): Promise<T>;
}

/** Edits that something else remembers. */
export interface DeferredUndo {
  readonly undoTitle: string | null;
  readonly redoTitle: string | null;
  undo(): void;
  redo(): void;
}

export interface Page {
  /** As it is now: what reads it in an effect or a component follows its changes. */
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
  readonly theme: Signal<"light" | "dark">;
  /** Who is at this page. */
  readonly people: ReadonlySignal<People>;
}
