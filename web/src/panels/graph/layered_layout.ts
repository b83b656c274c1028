/** Layered drawings of directed graphs, laid out by dagre. */

import { Graph, layout } from "@dagrejs/dagre";

export interface Box {
  readonly id: string;
  readonly width: number;
  readonly height: number;
}

export interface Arrow {
  readonly from: string;
  readonly to: string;
}

export interface Placed {
  /** Centre of each box [px]. */
  readonly boxes: ReadonlyMap<string, readonly [number, number]>;
  /** Path of each arrow, in the order of the arrows. */
  readonly paths: readonly string[];
  readonly width: number;
  readonly height: number;
}

const MARGIN = 8;

const BETWEEN = 14; // px
/** Boxes without arrows fill rows at least this wide [px]. */
const ROW_WIDTH = 560;

/** Lay boxes out from left to right, or from top to bottom; boxes without arrows in rows below. */
export function layered(boxes: readonly Box[], arrows: readonly Arrow[], direction: "LR" | "TB"): Placed {
  const joined = new Set(arrows.flatMap(({ from, to }) => [from, to]));
  const drawing = arranged(
    boxes.filter(({ id }) => joined.has(id)),
    arrows,
    direction,
  );
  return withRows(
    drawing,
    boxes.filter(({ id }) => !joined.has(id)),
  );
}

function withRows(drawing: Placed, lone: readonly Box[]): Placed {
  const centres = new Map(drawing.boxes);
  const widest = Math.max(ROW_WIDTH, drawing.width);
  let [x, y, width] = [MARGIN, drawing.boxes.size > 0 ? drawing.height : MARGIN, drawing.width];
  let row = 0; // height of the highest box [px]
  for (const box of lone) {
    if (x > MARGIN && x + box.width + MARGIN > widest) [x, y, row] = [MARGIN, y + row + BETWEEN, 0];
    centres.set(box.id, [x + box.width / 2, y + box.height / 2]);
    width = Math.max(width, x + box.width + MARGIN);
    row = Math.max(row, box.height);
    x += box.width + BETWEEN;
  }
  return { ...drawing, boxes: centres, width, height: lone.length > 0 ? y + row + MARGIN : drawing.height };
}

function arranged(boxes: readonly Box[], arrows: readonly Arrow[], direction: "LR" | "TB"): Placed {
  const graph = new Graph({ multigraph: true });
  graph.setGraph({ rankdir: direction, nodesep: BETWEEN, ranksep: 44, edgesep: 8, marginx: MARGIN, marginy: MARGIN });
  graph.setDefaultEdgeLabel(() => ({}));
  const names = new Set([...boxes.map(({ id }) => id), ...arrows.flatMap(({ from, to }) => [from, to])]);
  const ids = new Map([...names].map((name, index) => [name, String(index)])); // dagre's ids are object keys, so a name like __proto__ is unsafe
  const node = (id: string): string => ids.get(id) ?? "";
  for (const { id, width, height } of boxes) graph.setNode(node(id), { width, height });
  arrows.forEach(({ from, to }, index) => graph.setEdge(node(from), node(to), {}, String(index)));
  if (boxes.length > 0) layout(graph);
  const centres = new Map(
    boxes.map(({ id }) => {
      const { x = 0, y = 0 } = graph.node(node(id)) as { x?: number; y?: number };
      return [id, [x, y] as const];
    }),
  );
  const paths = arrows.map(({ from, to }, index) => {
    const { points = [] } = graph.edge(node(from), node(to), String(index)) as {
      points?: readonly { x: number; y: number }[];
    };
    return curve(points.map(({ x, y }) => [x, y] as const));
  });
  const { width = 0, height = 0 } = graph.graph() as { width?: number; height?: number };
  return { boxes: centres, paths, width: Math.max(1, width), height: Math.max(1, height) };
}

/** A smooth line through points: quadratic curves between the midpoints. */
function curve(points: readonly (readonly [number, number])[]): string {
  const [first, ...rest] = points;
  if (first === undefined) return "";
  let path = `M${pair(first)}`;
  rest.forEach((point, index) => {
    const next = rest[index + 1];
    if (next === undefined) path += index === 0 ? `L${pair(point)}` : `T${pair(point)}`;
    else path += `Q${pair(point)} ${pair([(point[0] + next[0]) / 2, (point[1] + next[1]) / 2])}`;
  });
  return path.replace(/T([^T]*)$/, "L$1");
}

function pair([x, y]: readonly [number, number]): string {
  return `${x.toFixed(1)} ${y.toFixed(1)}`;
}
