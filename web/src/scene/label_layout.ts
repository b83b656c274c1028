/**
 * Places of labels in the picture.
 *
 * A label stands beside its anchor at the end of a leader, where a band of 20 px is free of other labels and anchors;
 * a label without such a place is not shown. The hovered label always is.
 */

import type { Area } from "./free_area";

/** Height of a label's band, and the room that it needs [px]. */
export const BAND = 20;
/** Distances of a label from its anchor [px]. */
const ACROSS = 24;
const UP = 18;

/** Rectangle in the picture [px]. */
interface LabelBox {
  x: number;
  y: number;
  width: number;
}

/** Request of a label and its assigned position, renewed for each picture. */
export interface LabelRequest {
  /** Anchor [px]. */
  x: number;
  y: number;
  /** Width of the text [px]. */
  width: number;
  /** Depth in the picture, −1…1: nearer labels have priority. */
  distance: number;
  /** True: the label has priority and is always placed, like a person's name. */
  hovered: boolean;
  /** Rank among labels of which only a few are placed; null: not ranked. */
  rank: number | null;
  /** Index of its corner; the last corner is tried first, so that labels do not jump; −1: not placed. */
  corner: number;
  /** Position, if placed. */
  readonly box: LabelBox;
}

/** Right up, left up, right down, left down. */
const CORNERS = [
  [1, -1],
  [-1, -1],
  [1, 1],
  [-1, 1],
] as const;

/** Number of ranked labels in a picture, besides the hovered one. */
const FEW = 3;

/**
 * Place the requests within an area [px], or mark them as not placed; sorts them by priority.
 *
 * `isCovered` is asked for ranked labels alone, and only until a few have a place.
 */
export function layoutLabels<Request extends LabelRequest>(
  requests: Request[],
  area: Area,
  isCovered: (request: Request) => boolean = () => false,
): void {
  sort(requests);
  let few = 0;
  for (let i = 0; i < requests.length; i += 1) {
    const request = requests[i];
    if (request === undefined) continue;
    const isRanked = request.rank !== null && !request.hovered;
    if (isRanked && (few === FEW || isCovered(request))) request.corner = -1;
    else place(request, i, requests, area);
    if (isRanked && request.corner >= 0) few += 1;
  }
}

function place(request: LabelRequest, index: number, requests: readonly LabelRequest[], area: Area): void {
  if (request.corner > 0 && fits(request, request.corner, index, requests, area)) return;
  let corner = 0;
  while (corner < CORNERS.length && !fits(request, corner, index, requests, area)) corner += 1;
  request.corner = corner < CORNERS.length ? corner : -1;
  if (request.corner >= 0 || !request.hovered) return;
  request.corner = 0;
  putBox(request, 0);
  moveInside(request.box, area);
}

/** Insertion sort, since the order hardly changes from picture to picture. */
function sort(requests: LabelRequest[]): void {
  for (let i = 1; i < requests.length; i += 1) {
    const moved = requests[i];
    if (moved === undefined) continue;
    let at = i;
    for (; at > 0; at -= 1) {
      const before = requests[at - 1];
      if (before === undefined || order(before) <= order(moved)) break;
      requests[at] = before;
    }
    requests[at] = moved;
  }
}

/** Sort key: hovered labels first, then by rank, then by depth, which is below 1. */
function order({ hovered, rank, distance }: LabelRequest): number {
  return hovered ? -Infinity : distance + 2 * (rank ?? 0);
}

/** Put a request's box at a corner; true: it may stay there. */
function fits(
  request: LabelRequest,
  corner: number,
  index: number,
  requests: readonly LabelRequest[],
  { left, top, width, height }: Area,
): boolean {
  putBox(request, corner);
  const { box } = request;
  if (box.x < left || box.y < top || box.x + box.width > left + width || box.y + BAND > top + height) return false;
  for (let i = 0; i < requests.length; i += 1) {
    const other = requests[i];
    if (other === undefined || i === index) continue;
    if (isInside(other.x, other.y, box) || (i < index && other.corner >= 0 && overlap(box, other.box))) return false;
  }
  return true;
}

function putBox({ box, x, y, width }: LabelRequest, corner: number): void {
  const [right, down] = CORNERS[corner] ?? CORNERS[0];
  box.x = right > 0 ? x + ACROSS : x - ACROSS - width;
  box.y = y + down * UP - BAND / 2;
  box.width = width;
}

function overlap(a: LabelBox, b: LabelBox): boolean {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + BAND && b.y < a.y + BAND;
}

function isInside(x: number, y: number, box: LabelBox): boolean {
  return x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + BAND;
}

function moveInside(box: LabelBox, { left, top, width, height }: Area): void {
  box.x = Math.max(left, Math.min(left + width - box.width, box.x));
  box.y = Math.max(top, Math.min(top + height - BAND, box.y));
}
