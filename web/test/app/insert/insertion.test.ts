// @vitest-environment jsdom
/** What is put into the world, and taken out again. */

import { signal } from "@preact/signals";
import { Vector3 } from "three";
import { expect, it, vi } from "vitest";

import { Insertion } from "../../../src/app/insert/insertion";
import type { Shell } from "../../../src/app/shell";
import type { Insertable } from "../../../src/page/insertable";
import { fakePage } from "../../fake_page";

const BOX: Insertable = { kind: "shape", name: "box", title: "Box" };

it("is what undo takes back, though the server has not answered yet", async () => {
  const page = fakePage();
  const tool = { chosen: signal(null), onPlace: (_thing: Insertable, _point: Vector3): void => undefined };
  Object.assign(page, { tools: { insert: tool, current: signal(null) } });
  let answer = (_: { readonly name: string }): void => undefined;
  vi.spyOn(page.connection, "request").mockImplementation(() => new Promise((resolve) => (answer = resolve)));
  const asked: string[] = [];
  const request = (_title: string, name: string): void => void asked.push(name);
  const insertion = new Insertion({ page, request, layout: {} } as unknown as Shell);
  expect(insertion.asked.value).toBeNull();
  page.undo.record(
    "Earlier",
    () => undefined,
    () => asked.push("earlier"),
  );

  tool.onPlace(BOX, new Vector3());
  page.undo.undo();
  expect(asked).toEqual([]);
  answer({ name: "box_0" });
  await vi.waitFor(() => expect(asked).toEqual(["delete"]));
  expect(page.undo.undoTitle.value).toBe("Earlier");
});
