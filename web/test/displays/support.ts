/** What displays work with, without a server or a canvas. */

import { signal } from "@preact/signals";
import { Group, PerspectiveCamera, Quaternion, Vector3, type Object3D } from "three";

import type { UndoStack } from "../../src/displays/undo_stack";
import type { DisplayContext } from "../../src/displays/display";
import type { FrameInfo, FrameTree } from "../../src/frames/frame_tree";
import { NoTransform, type Transform } from "../../src/frames/transform";
import type { Label, SceneView } from "../../src/scene/scene_view";
import { AXIS_RGB } from "../../src/shapes/axes";
import { GraphNames } from "../../src/protocol/graph_names";
import { FakeConnection } from "../fake_connection";
import { GhostShapes } from "../../src/scene/world/ghost_shapes";

/** Frames at fixed poses in one root. */
export class FakeFrames implements FrameTree {
  readonly frames = signal<readonly string[]>([]);
  private readonly poses = new Map<string, Transform>();
  private readonly infos = new Map<string, FrameInfo>();

  set(
    name: string,
    parent: string | null,
    position: readonly [number, number, number] = [0, 0, 0],
    info: Partial<FrameInfo> = {},
  ): void {
    this.poses.set(name, { position: new Vector3(...position), orientation: new Quaternion() });
    this.infos.set(name, { name, parent, isStatic: false, stamp: 0n, rate: null, publisher: null, ...info });
    this.frames.value = [...this.infos.keys()].sort();
  }

  turn(name: string, orientation: Quaternion): void {
    this.poses.get(name)?.orientation.copy(orientation);
  }

  forget(name: string): void {
    this.poses.delete(name);
    this.infos.delete(name);
    this.frames.value = [...this.infos.keys()].sort();
  }

  describe(): readonly FrameInfo[] {
    return [...this.infos.values()];
  }

  lookup(target: string, source: string): Transform | NoTransform {
    const [to, from] = [this.poses.get(target), this.poses.get(source.replace(/^\//, ""))];
    if (to === undefined || from === undefined) {
      return new NoTransform(
        `No transform from [${source}] to [${target}]`,
        `Frames here: ${this.frames.peek().join(", ")}`,
      );
    }
    const inverse = to.orientation.clone().invert();
    return {
      position: from.position.clone().sub(to.position).applyQuaternion(inverse),
      orientation: inverse.clone().multiply(from.orientation),
    };
  }
}

class FakeScene {
  readonly displays = new Group();
  readonly world = new Group();
  readonly camera = signal(new PerspectiveCamera());
  readonly paneSize = signal({ width: 1000, height: 800 });
  readonly labels: Label[] = [];
  frames = 0;

  invalidate(): void {
    this.frames++;
  }

  addStep(): () => void {
    return () => undefined;
  }

  addLabel(anchor: Object3D, text: string): Label {
    const label: Label = {
      anchor,
      text,
      detail: "",
      full: "",
      rank: null,
      isQuiet: false,
      reach: 0,
      remove: () => void this.labels.splice(this.labels.indexOf(label), 1),
    };
    this.labels.push(label);
    return label;
  }
}

/** Runs at once and remembers. */
export class FakeUndo implements UndoStack {
  readonly undoTitle = signal<string | null>(null);
  readonly redoTitle = signal<string | null>(null);
  private readonly done: { title: string; redo: () => void; undo: () => void }[] = [];
  private readonly undone: { title: string; redo: () => void; undo: () => void }[] = [];

  run(title: string, redo: () => void, undo: () => void): void {
    redo();
    this.done.push({ title, redo, undo });
    this.undoTitle.value = title;
  }

  record(title: string, _redo: () => void, undo: () => void): void {
    this.run(title, () => undefined, undo);
  }
  undo(): void {
    const edit = this.done.pop();
    edit?.undo();
    if (edit !== undefined) this.undone.push(edit);
  }

  redo(): void {
    const edit = this.undone.pop();
    edit?.redo();
    if (edit !== undefined) this.done.push(edit);
  }
}

export interface Setup {
  readonly connection: FakeConnection;
  readonly frames: FakeFrames;
  readonly scene: FakeScene;
  readonly context: DisplayContext;
}

export function setup(fixedFrame = "map"): Setup {
  const [connection, frames, scene] = [new FakeConnection(), new FakeFrames(), new FakeScene()];
  frames.set(fixedFrame, null);
  const context: DisplayContext = {
    connection,
    names: new GraphNames(),
    frames,
    scene: scene as unknown as SceneView,
    displays: signal([]),
    fixedFrame: signal(fixedFrame),
    axisColors: signal(AXIS_RGB),
    ghostShapes: new GhostShapes(),
  };
  return { connection, frames, scene, context };
}
