/** What a display works with, for tests: no server, no canvas, frames that a test sets. */

import { signal } from "@preact/signals";
import { Group, PerspectiveCamera, Quaternion, Vector3 } from "three";

import type { Display, DisplayContext } from "../../src/displays/display";
import type { FrameTree } from "../../src/frames/frame_tree";
import { NoTransform, type Transform } from "../../src/frames/transform";
import type { SceneView } from "../../src/scene/scene_view";
import { AXIS_RGB } from "../../src/shapes/axes";
import { GraphNames } from "../../src/protocol/graph_names";
import { FakeConnection } from "../fake_connection";
import { GhostShapes } from "../../src/scene/world/ghost_shapes";

class FakeFrames implements Partial<FrameTree> {
  readonly frames = signal<readonly string[]>([]);
  readonly poses = new Map<string, (time: bigint) => Transform | null>();

  /** A frame stands still in the fixed frame. */
  set(frame: string, x = 0, y = 0, z = 0, orientation = new Quaternion()): void {
    this.poses.set(frame, () => ({ position: new Vector3(x, y, z), orientation }));
  }

  lookup(target: string, source: string, time: bigint): Transform | NoTransform {
    return (
      this.poses.get(source)?.(time) ??
      new NoTransform(`No transform from [${source}] to [${target}]`, `Nothing publishes ${source}.`)
    );
  }
}

export interface Fakes {
  readonly context: DisplayContext;
  readonly connection: FakeConnection;
  readonly frames: FakeFrames;
  readonly fixedFrame: ReturnType<typeof signal<string>>;
  readonly invalidated: { count: number };
}

export function fakes(): Fakes {
  const connection = new FakeConnection();
  const frames = new FakeFrames();
  frames.set("map");
  const fixedFrame = signal("map");
  const invalidated = { count: 0 };
  const scene = {
    displays: new Group(),
    world: new Group(),
    camera: signal(new PerspectiveCamera()),
    invalidate: () => void (invalidated.count += 1),
  } as unknown as SceneView;
  return {
    context: {
      connection,
      names: new GraphNames(),
      frames: frames as unknown as FrameTree,
      scene,
      displays: signal([]),
      fixedFrame,
      axisColors: signal(AXIS_RGB),
      ghostShapes: new GhostShapes(),
    },
    connection,
    frames,
    fixedFrame,
    invalidated,
  };
}

export function header(
  frame: string,
  seconds = 1,
): { seq: number; stamp: { sec: number; nsec: number }; frame_id: string } {
  return { seq: 0, stamp: { sec: Math.floor(seconds), nsec: Math.round((seconds % 1) * 1e9) }, frame_id: frame };
}

/** A display's status by its name, as `warn: No messages received`. */
export function status(display: Display, name: string): string | undefined {
  const status = display.statuses.peek().get(name);
  return status === undefined ? undefined : `${status.level}: ${status.text}`;
}
