/** Drawing that follows properties. */

import { effect, untracked } from "@preact/signals";

import type { Property } from "../rviz/properties";

/** Call `draw` now and whenever one of the properties or those below them changes, but read-outs; returns how to stop. */
export function watch(properties: readonly Property<unknown>[], draw: () => void): () => void {
  return effect(() => {
    readValues(properties);
    untracked(draw);
  });
}

/** Read the properties and those below them, but read-outs, so that an effect follows them. */
export function readValues(properties: readonly Property<unknown>[]): readonly unknown[] {
  return properties.flatMap((property) =>
    property.options.readOnly === true
      ? []
      : [property.value.value, property.version.value, ...readValues(property.children)],
  );
}
