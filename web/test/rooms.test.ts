import { globSync, readFileSync } from "node:fs";
import { dirname, relative, resolve } from "node:path";

import { expect, it } from "vitest";

const SOURCE = resolve(import.meta.dirname, "../src");
/** From the ground up: a room imports from those below it; of one floor, from each other. */
const FLOORS = [
  ["protocol"],
  ["frames"],
  ["rviz"],
  ["shapes", "theme"],
  ["scene"],
  ["displays"],
  ["page"],
  ["panels", "tools"],
  ["app"],
  ["replay"],
];

function floorOf(file: string): number {
  const [room = ""] = relative(SOURCE, file).split("/");
  return FLOORS.findIndex((rooms) => rooms.includes(room));
}

function imported(file: string): string[] {
  const specifiers = readFileSync(file, "utf8").matchAll(/(?:from |import\()"(\.[^"]+)"/g);
  return [...specifiers].map(([, path = ""]) => resolve(dirname(file), path));
}

it("imports only from its own floor or lower ones", () => {
  const files = globSync("*/**/*.{ts,tsx}", { cwd: SOURCE }).map((file) => resolve(SOURCE, file));
  expect(files.length).toBeGreaterThan(300);
  const upward = files.flatMap((file) =>
    imported(file)
      .filter((target) => floorOf(target) > floorOf(file) || floorOf(file) < 0)
      .map((target) => `${relative(SOURCE, file)} imports ${relative(SOURCE, target)}`),
  );
  expect(upward).toEqual([]);
});
