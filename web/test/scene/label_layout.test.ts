import { expect, test } from "vitest";

import { BAND, layoutLabels, type LabelRequest } from "../../src/scene/label_layout";

const AREA = { left: 0, top: 0, width: 800, height: 600 };

function request(x: number, y: number, changes: Partial<LabelRequest> = {}): LabelRequest {
  return {
    x,
    y,
    width: 60,
    distance: 1,
    hovered: false,
    rank: null,
    corner: -1,
    box: { x: 0, y: 0, width: 0 },
    ...changes,
  };
}

/** Requests that got a place, those that come first first. */
function placed(requests: readonly LabelRequest[]): LabelRequest[] {
  const sorted = [...requests];
  layoutLabels(sorted, AREA);
  return sorted.filter(({ corner }) => corner >= 0);
}

test("labels never overlap, and nearer ones have priority", () => {
  const requests = Array.from({ length: 40 }, (_, i) => request(300 + 3 * i, 200 + 2 * i, { distance: 40 - i }));

  const shown = placed(requests);

  expect(shown.length).toBeGreaterThan(0);
  expect(shown.length).toBeLessThan(40);
  expect(shown[0]).toBe(requests[39]);
  for (const [i, { box: a }] of shown.entries()) {
    for (const { box: b } of shown.slice(i + 1)) {
      const apart = a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + BAND <= b.y || b.y + BAND <= a.y;
      expect(apart).toBe(true);
    }
  }
});

test("a label covers no other's anchor", () => {
  const requests = [request(100, 100), request(140, 82)];

  for (const shown of placed(requests)) {
    const { box } = shown;
    const other = requests.find((request) => request !== shown);
    const isInside =
      other !== undefined &&
      other.x >= box.x &&
      other.x <= box.x + box.width &&
      other.y >= box.y &&
      other.y <= box.y + BAND;
    expect(isInside).toBe(false);
  }
});

test("the hovered label is shown within the picture even without free space", () => {
  const crowd = Array.from({ length: 30 }, (_, i) => request(780 + (i % 5), 10 + i, { distance: 0.1 }));

  const [hovered] = placed([...crowd, request(795, 20, { hovered: true, width: 150 })]);

  expect(hovered?.hovered).toBe(true);
  expect(hovered?.box.x).toBeLessThanOrEqual(650);
  expect(hovered?.box.y).toBeGreaterThanOrEqual(0);
});

test("a label keeps its corner while that is free", () => {
  expect(placed([request(400, 300)])[0]?.corner).toBe(0);
  expect(placed([request(400, 300, { corner: 3 })])[0]?.corner).toBe(3);
});

test("three ranked labels are shown, the lowest ranks first, and the hovered one besides", () => {
  const frames = Array.from({ length: 8 }, (_, rank) => request(100, 60 * (8 - rank), { rank }));
  const hovered = request(500, 300, { rank: 9, hovered: true });

  expect(new Set(placed([...frames, hovered]))).toEqual(new Set([hovered, ...frames.slice(0, 3)]));
});

test("no label is under what covers the edges of the picture", () => {
  const edge = request(105, 300);
  layoutLabels([edge], { left: 100, top: 50, width: 600, height: 500 });

  expect(edge.box.x).toBeGreaterThanOrEqual(100);
  const outside = request(690, 55, { width: 640 });
  layoutLabels([outside], { left: 100, top: 50, width: 600, height: 500 });
  expect(outside.corner).toBe(-1);
});

test("a covered label leaves its place to the next, and nobody looks for more than are shown", () => {
  const frames = Array.from({ length: 50 }, (_, rank) => request(100, 10 + 11 * (50 - rank), { rank }));
  const asked: (number | null)[] = [];
  layoutLabels(frames, AREA, ({ rank }) => {
    asked.push(rank);
    return rank === 1;
  });

  expect(frames.find(({ rank }) => rank === 1)?.corner).toBe(-1);
  expect(frames.filter(({ corner }) => corner >= 0)).toHaveLength(3);
  expect(asked.length).toBeLessThan(50);
});
