/** Undoable changes of displays' properties. */

import type { Property, Yaml } from "../rviz/properties";
import type { Page } from "./page";

/** Set a property from a file's value, undoable; a value of the wrong kind changes nothing. */
export function changeProperty(page: Page, property: Property<unknown>, yaml: Yaml): void {
  const before = property.value.peek();
  page.displays.edit(
    `Change of ${property.name}`,
    () => property.decode(yaml),
    () => (property.value.value = before),
  );
}
