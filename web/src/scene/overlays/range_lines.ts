/** Rays of lidars, what they hit, and cones of sonars, from `trundle/ranges` while they are shown. */

import { computed, effect, untracked } from "@preact/signals";

import type { Connection } from "../../protocol/connection";
import type { SceneView } from "../scene_view";
import type { SimulatedWorld } from "../simulated_world";
import { readLines, WorldLines } from "../world/world_lines";

const PARTS = ["rays", "points", "sonars"] as const;

export class RangeLines {
  private readonly lines = new WorldLines();
  private readonly stop: () => void;

  constructor(scene: SceneView, { shown }: SimulatedWorld, connection: Connection) {
    const isShown = computed(() => PARTS.some((part) => shown.any(part)));
    this.stop = effect(() => {
      if (!isShown.value) return;
      scene.world.add(this.lines);
      const draw = (payload: DataView): void => {
        const read = readLines(payload);
        if (read === null) return;
        this.lines.show(
          read.filter(({ id }) => PARTS.some((part) => id.startsWith(`${part} `) && shown.of(part, modelOf(id)))),
        );
        scene.invalidate();
      };
      const subscription = untracked(() => connection.subscribeRaw("trundle/ranges", draw));
      return () => {
        subscription.close();
        this.lines.show([]);
        this.lines.removeFromParent();
        scene.invalidate();
      };
    });
  }

  dispose(): void {
    this.stop();
  }
}

/** The model in `rays model::link::sensor`. */
function modelOf(id: string): string {
  return id
    .slice(id.indexOf(" ") + 1)
    .split("::")
    .slice(0, -2)
    .join("::");
}
