/** Properties as rows of a tree. */

import type { Property } from "../../rviz/properties";
import { Icon } from "../../theme/icons";
import type { TreeRow } from "../../theme/tree";
import type { Page } from "../../page/page";
import { PropertyEditor } from "./property_editor";

export interface RowsOf {
  readonly page: Page;
  readonly isOpen: (key: string) => boolean;
  readonly onToggle: (key: string, open: boolean) => void;
}

/** Rows of the visible properties, and of the children of open rows. */
export function propertyRows(
  properties: readonly Property<unknown>[],
  parent: string,
  depth: number,
  rows: RowsOf,
): TreeRow[] {
  return properties.flatMap((property, index) => {
    if (property.options.visible?.value === false) return [];
    const key = `${parent}/${index}.${property.name}`;
    const hasChildren = property.version.value >= 0 && property.children.length > 0; // reading `version` follows added and removed children
    const open = hasChildren ? rows.isOpen(key) : undefined;
    const below = open === true ? propertyRows(property.children, key, depth + 1, rows) : [];
    return [propertyRow(property, key, depth, open, rows), ...below];
  });
}

function propertyRow(
  property: Property<unknown>,
  key: string,
  depth: number,
  open: boolean | undefined,
  rows: RowsOf,
): TreeRow {
  return {
    key,
    depth,
    open,
    class: "prop",
    content: (
      <>
        <span
          class="k"
          data-tip={property.options.description}
          onClick={() => open !== undefined && rows.onToggle(key, !open)}
        >
          {open !== undefined && <Icon name="right" class={open ? "tw o" : "tw"} />}
          {property.name}
        </span>
        <span class="v">
          <PropertyEditor page={rows.page} property={property} />
        </span>
      </>
    ),
  };
}
