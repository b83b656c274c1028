import { expect, test } from "vitest";

import { ArrivalStatistics } from "../../src/protocol/topic_statistics";

function arrivals(count: number, every: number, bytes = 10): ArrivalStatistics {
  const statistics = new ArrivalStatistics();
  for (let i = 0; i < count; i++) statistics.add(i * every, bytes);
  return statistics;
}

test("no rate before the second message", () => {
  expect(arrivals(0, 0).at(0)).toEqual({ rate: null, bandwidth: 0, lastAt: null, count: 0, dropped: 0 });
  expect(arrivals(1, 0).at(0)).toEqual({ rate: null, bandwidth: 0, lastAt: 0, count: 1, dropped: 0 });
});

test.each([
  [50, 20],
  [1000, 1],
  [10, 1000],
  [3, 20_000],
])("%d messages, one each %d ms", (count, every) => {
  const last = (count - 1) * every;
  expect(arrivals(count, every).at(last)).toEqual({
    rate: expect.closeTo(1000 / every) as number,
    bandwidth: expect.closeTo(10_000 / every) as number,
    lastAt: last,
    count,
    dropped: 0,
  });
});

test("only the last seconds count", () => {
  const statistics = arrivals(100, 100);
  for (let i = 0; i < 10; i++) statistics.add(20_000 + i * 500, 10);

  expect(statistics.at(24_500).rate).toBeCloseTo(2);
});

test("a silent topic has rate 0", () => {
  expect(arrivals(100, 10).at(990 + 5001)).toMatchObject({ rate: 0, bandwidth: 0 });
});
