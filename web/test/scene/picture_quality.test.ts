import { expect, it } from "vitest";

import { PictureQuality } from "../../src/scene/picture_quality";

it("is quick while something changes and sharp in one more picture at rest, where the CPU draws", () => {
  const quality = new PictureQuality(true);
  const pictures: [number, number][] = [];
  for (let now = 0; now < 2000; now += 50)
    if (quality.choose(now === 100 || now === 150 || now === 1000, now)) pictures.push([now, quality.samples]);
  expect(pictures.filter(([now]) => now >= 100)).toEqual([
    [100, 0],
    [150, 0],
    [450, 4],
    [1000, 0],
    [1300, 4],
  ]);
});

it("is always sharp with a graphics processor", () => {
  const quality = new PictureQuality(false);
  expect([quality.choose(true, 0), quality.samples, quality.choose(false, 1000)]).toEqual([true, 4, false]);
});
