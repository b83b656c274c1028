/** Shapes of robots by their links' frames; the ghost of a bag consists of them. */

import { signal, type ReadonlySignal } from "@preact/signals";
import type { Object3D } from "three";

/** Returns the shapes in a frame's axes; null: it has none. */
export type FindShape = (frame: string) => Object3D | null;

export class GhostShapes {
  private readonly sources = new Set<FindShape>();
  private readonly count = signal(0);

  /** Changes when shapes come or go. */
  get revision(): ReadonlySignal<number> {
    return this.count;
  }

  /** Add a robot's shapes; returns a function that removes them. */
  add(find: FindShape): () => void {
    this.sources.add(find);
    this.change();
    return () => {
      this.sources.delete(find);
      this.change();
    };
  }

  /** Note that a robot's shapes have changed. */
  change(): void {
    this.count.value = this.count.peek() + 1;
  }

  /** Shapes of a frame, of the first robot that has them. */
  find(frame: string): Object3D | null {
    for (const find of this.sources) {
      const shape = find(frame);
      if (shape !== null) return shape;
    }
    return null;
  }
}
