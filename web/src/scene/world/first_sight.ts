/** What happens once the simulated world can be seen. */

import { effect } from "@preact/signals";

import type { SimulatedWorld } from "../simulated_world";

/** Call once when the files of the first manifest are there; returns how to stop waiting. */
export function whenSeen(world: SimulatedWorld, act: () => void): () => void {
  let isDone = false;
  return effect(() => {
    const isLoaded = world.manifest.value !== null && world.progress.value === 1;
    if (!isLoaded || isDone) return;
    isDone = true;
    act();
  });
}
