/** Drawing that follows properties. */

import { effect, untracked } from "@preact/signals";

import type { Property } from "../rviz/properties";

/** Call `draw` now and when a property or a child changes, except read-outs; returns a function that stops. */
export function watch(properties: readonly Property<unknown>[], draw: () => void): () => void {
  return effect(() => {
    readValues(properties);
    untracked(draw);
  });
}

/** Read the properties and their children, except read-outs, so that an effect follows them. */
export function readValues(properties: readonly Property<unknown>[]): readonly unknown[] {
  return properties.flatMap((property) =>
    property.options.readOnly === true
      ? []
      : [property.value.value, property.version.value, ...readValues(property.children)],
  );
}
