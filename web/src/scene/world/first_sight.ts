/** Waits until the simulated world is visible. */

import { effect } from "@preact/signals";

import type { SimulatedWorld } from "../simulated_world";

/** Call a function once when the files of the first manifest are loaded; returns a function that stops waiting. */
export function whenLoaded(world: SimulatedWorld, act: () => void): () => void {
  let isDone = false;
  return effect(() => {
    const isLoaded = world.manifest.value !== null && world.progress.value === 1;
    if (!isLoaded || isDone) return;
    isDone = true;
    act();
  });
}
