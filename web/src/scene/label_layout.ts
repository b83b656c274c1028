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

export interface LabelBox {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

export interface LabelRequest {
  /** Anchor [px]. */
  readonly x: number;
  readonly y: number;
  /** Width of the text [px]. */
  readonly width: number;
  /** Distance to the camera: nearer labels come first. */
  readonly distance: number;
  /** True: it comes first, and always has a place; that of a person's name, too. */
  readonly hovered: boolean;
  /** Corner of the last time, so that labels do not jump; −1: none. */
  readonly corner: number;
}

export interface PlacedLabel {
  /** Index of the request. */
  readonly index: number;
  readonly box: LabelBox;
  readonly corner: number;
}

/** Right up, left up, right down, left down. */
const CORNERS = [
  [1, -1],
  [-1, -1],
  [1, 1],
  [-1, 1],
] as const;

export function layoutLabels(requests: readonly LabelRequest[], width: number, height: number): PlacedLabel[] {
  const order = requests.map((_, index) => index);
  const key = (index: number): number => (requests[index]?.hovered === true ? -1 : (requests[index]?.distance ?? 0));
  order.sort((a, b) => key(a) - key(b));
  const placed: PlacedLabel[] = [];
  for (const index of order) {
    const request = requests[index];
    if (request === undefined) continue;
    const free = candidates(request).find(({ box }) => isFree(box, index, requests, placed, width, height));
    if (free !== undefined) placed.push({ index, ...free });
    else if (request.hovered) placed.push({ index, box: inside(boxAt(request, 0), width, height), corner: 0 });
  }
  return placed;
}

function candidates(request: LabelRequest): { box: LabelBox; corner: number }[] {
  const corners = [0, 1, 2, 3];
  if (request.corner > 0) corners.unshift(request.corner);
  return corners.map((corner) => ({ box: boxAt(request, corner), corner }));
}

function boxAt(request: LabelRequest, corner: number): LabelBox {
  const [right, down] = CORNERS[corner] ?? CORNERS[0];
  const x = right > 0 ? request.x + ACROSS : request.x - ACROSS - request.width;
  return { x, y: request.y + down * UP - BAND / 2, width: request.width, height: BAND };
}

function isFree(
  box: LabelBox, own: number, requests: readonly LabelRequest[], placed: readonly PlacedLabel[], width: number, height: number,
): boolean {
  if (box.x < 0 || box.y < 0 || box.x + box.width > width || box.y + box.height > height) return false;
  if (placed.some((other) => overlap(box, other.box))) return false;
  return !requests.some((other, index) => index !== own && isInside(other.x, other.y, box));
}

function overlap(a: LabelBox, b: LabelBox): boolean {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

function isInside(x: number, y: number, box: LabelBox): boolean {
  return x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height;
}

function inside(box: LabelBox, width: number, height: number): LabelBox {
  const x = Math.max(0, Math.min(width - box.width, box.x));
  return { ...box, x, y: Math.max(0, Math.min(height - box.height, box.y)) };
}
