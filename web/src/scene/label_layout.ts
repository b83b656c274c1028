/**
 * Places of labels in the picture.
 *
 * A label stands beside its anchor at the end of a leader, where a band of 20 px is free of other labels and anchors;
 * one without such a place is not shown. The hovered one always is.
 */

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
  /** Distance to the camera: nearer labels have priority. */
  distance: number;
  /** True: has priority and is always placed, as is a person's name. */
  hovered: boolean;
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

/** Place the requests, or mark them as not placed; sorts them by priority. */
export function layoutLabels(requests: LabelRequest[], width: number, height: number): void {
  sort(requests);
  for (let i = 0; i < requests.length; i += 1) {
    const request = requests[i];
    if (request === undefined) continue;
    if (request.corner > 0 && fits(request, request.corner, i, requests, width, height)) continue;
    let corner = 0;
    while (corner < CORNERS.length && !fits(request, corner, i, requests, width, height)) corner += 1;
    request.corner = corner < CORNERS.length ? corner : -1;
    if (request.corner < 0 && request.hovered) {
      request.corner = 0;
      putBox(request, 0);
      moveInside(request.box, width, height);
    }
  }
}

/** Insertion sort, since the order hardly changes from picture to picture. */
function sort(requests: LabelRequest[]): void {
  for (let i = 1; i < requests.length; i += 1) {
    const moved = requests[i];
    if (moved === undefined) continue;
    let at = i;
    for (; at > 0; at -= 1) {
      const before = requests[at - 1];
      if (before === undefined || rank(before) <= rank(moved)) break;
      requests[at] = before;
    }
    requests[at] = moved;
  }
}

function rank({ hovered, distance }: LabelRequest): number {
  return hovered ? -1 : distance;
}

/** Put a request's box at a corner; true: it may stay there. */
function fits(
  request: LabelRequest,
  corner: number,
  index: number,
  requests: readonly LabelRequest[],
  width: number,
  height: number,
): boolean {
  putBox(request, corner);
  const { box } = request;
  if (box.x < 0 || box.y < 0 || box.x + box.width > width || box.y + BAND > height) return false;
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

function moveInside(box: LabelBox, width: number, height: number): void {
  box.x = Math.max(0, Math.min(width - box.width, box.x));
  box.y = Math.max(0, Math.min(height - BAND, box.y));
}
