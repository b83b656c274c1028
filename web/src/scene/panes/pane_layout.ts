/** Layouts of the scene's panes, each with a view of its own. */

import { freeArea, type Area, type Insets } from "../free_area";

export const PANE_LAYOUTS = ["one", "beside", "stacked", "four"] as const;
export type PaneLayout = (typeof PANE_LAYOUTS)[number];

/** Area of a pane in the scene, and the insets of its edges that panels cover [px]. */
export interface PaneArea {
  readonly area: Area;
  readonly insets: Insets;
}

/** Column and row of each pane; of four, the first is at the top right, and top and front views share a column. */
const CELLS: Readonly<Record<PaneLayout, readonly (readonly [number, number])[]>> = {
  one: [[0, 0]],
  beside: [
    [0, 0],
    [1, 0],
  ],
  stacked: [
    [0, 0],
    [0, 1],
  ],
  four: [
    [1, 0],
    [0, 0],
    [0, 1],
    [1, 1],
  ],
};

/** Number of panes of a layout. */
export function paneCount(layout: PaneLayout): number {
  return CELLS[layout].length;
}

/**
 * Places of a layout's panes: the scene's free part is halved, and what panels cover belongs to the pane that it is next to.
 *
 * `head`: height that the tools cover at the top of several panes [px].
 */
export function paneAreas(
  layout: PaneLayout,
  size: { readonly width: number; readonly height: number },
  insets: Insets,
  head: number,
): readonly PaneArea[] {
  const free = freeArea(size.width, size.height, insets);
  const cells = CELLS[layout];
  const xs = edges(
    size.width,
    Math.round(free.left + free.width / 2),
    cells.some(([column]) => column === 1),
  );
  const ys = edges(
    size.height,
    Math.round(free.top + free.height / 2),
    cells.some(([, row]) => row === 1),
  );
  return cells.map(([column, row]) => {
    const [left = 0, right = 0] = xs.slice(column);
    const [top = 0, bottom = 0] = ys.slice(row);
    const tools = cells.length > 1 && row === 0 ? head : 0;
    return {
      area: { left, top, width: Math.max(1, right - left), height: Math.max(1, bottom - top) },
      insets: {
        left: column === 0 ? insets.left : 0,
        right: column === xs.length - 2 ? insets.right : 0,
        top: (row === 0 ? insets.top : 0) + tools,
        bottom: row === ys.length - 2 ? insets.bottom : 0,
      },
    };
  });
}

function edges(length: number, middle: number, isSplit: boolean): readonly number[] {
  return isSplit ? [0, middle, length] : [0, length];
}

export function isInside({ left, top, width, height }: Area, x: number, y: number): boolean {
  return x >= left && x < left + width && y >= top && y < top + height;
}
