import { describe, expect, test } from "vitest";

import { csvText } from "../../src/panels/plots/csv";
import { RingBuffer } from "../../src/panels/plots/ring_buffer";

describe("a ring buffer", () => {
  test("keeps the newest points as one contiguous view", () => {
    const buffer = new RingBuffer(100);
    for (let index = 0; index < 12_345; index += 1) buffer.push(index, -index);
    const [xs, ys] = buffer.between(-Infinity, Infinity);
    expect([xs.length, xs[0], xs.at(-1), ys.at(-1)]).toEqual([100, 12_245, 12_344, -12_344]);
    expect([...xs]).toEqual(Array.from({ length: 100 }, (_, index) => 12_245 + index));
  });

  test("returns one point beyond either edge", () => {
    const buffer = new RingBuffer(10);
    for (const x of [1, 2, 3, 4, 5]) buffer.push(x, 10 * x);
    expect([...buffer.between(2.5, 3.5)[0]]).toEqual([2, 3, 4]);
    expect([...buffer.between(9, 10)[0]]).toEqual([5]);
  });

  test("returns the value at a time", () => {
    const buffer = new RingBuffer(10);
    buffer.push(1, 10);
    buffer.push(2, 20);
    expect([buffer.at(0.9), buffer.at(1), buffer.at(1.9), buffer.at(2), buffer.at(99)]).toEqual([null, 10, 10, 20, 20]);
  });

  test("is cleared when time is reset", () => {
    const buffer = new RingBuffer(10);
    buffer.push(5, 1);
    buffer.push(4.9, 7);
    expect([buffer.length, buffer.lastY]).toEqual([1, 1]);
    buffer.push(0, 2);
    expect([buffer.length, buffer.lastX, buffer.lastY]).toEqual([1, 0, 2]);
  });
});

test("curves with their own times share rows only where times are equal", () => {
  const text = csvText([
    { name: "/a.x", xs: [0, 0.1], ys: [1, 2] },
    { name: 'joint "a", left', xs: [0.1, 0.1, 0.25], ys: [3, 5, 4] },
  ]);
  expect(text).toBe('time,/a.x,"joint ""a"", left"\n0,1,\n0.1,2,3\n0.1,,5\n0.25,,4\n');
});
