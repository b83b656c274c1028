import { expect, test } from "vitest";

import { layoutLabels, type LabelRequest } from "../../src/scene/label_layout";

function request(x: number, y: number, changes: Partial<LabelRequest> = {}): LabelRequest {
  return { x, y, width: 60, distance: 1, hovered: false, corner: -1, ...changes };
}

test("labels never overlap, and the nearer ones come first", () => {
  const requests = Array.from({ length: 40 }, (_, i) => request(300 + 3 * i, 200 + 2 * i, { distance: 40 - i }));

  const placed = layoutLabels(requests, 800, 600);

  expect(placed.length).toBeGreaterThan(0);
  expect(placed.length).toBeLessThan(40);
  expect(placed[0]?.index).toBe(39);
  for (const [i, { box: a }] of placed.entries()) {
    for (const { box: b } of placed.slice(i + 1)) {
      const apart = a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
      expect(apart).toBe(true);
    }
  }
});

test("a label covers no other's anchor", () => {
  const requests = [request(100, 100), request(140, 82)];

  for (const { box, index } of layoutLabels(requests, 800, 600)) {
    const other = requests[1 - index];
    const isInside = other !== undefined && other.x >= box.x && other.x <= box.x + box.width && other.y >= box.y && other.y <= box.y + box.height;
    expect(isInside).toBe(false);
  }
});

test("the hovered label is shown where there is no room, within the picture", () => {
  const crowd = Array.from({ length: 30 }, (_, i) => request(780 + (i % 5), 10 + i, { distance: 0.1 }));

  const placed = layoutLabels([...crowd, request(795, 20, { hovered: true, width: 150 })], 800, 600);

  const hovered = placed.find(({ index }) => index === 30);
  expect(hovered?.box.x).toBeLessThanOrEqual(650);
  expect(hovered?.box.y).toBeGreaterThanOrEqual(0);
});

test("a label keeps its corner while that is free", () => {
  expect(layoutLabels([request(400, 300)], 800, 600)[0]?.corner).toBe(0);
  expect(layoutLabels([request(400, 300, { corner: 3 })], 800, 600)[0]?.corner).toBe(3);
});
