// @vitest-environment jsdom
/** What is put into the world, and taken out again. */

import { signal } from "@preact/signals";
import { Vector3 } from "three";
import { expect, it, vi } from "vitest";

import { Insertion, type InsertionContext } from "../../../src/app/insert/insertion";
import type { Insertable } from "../../../src/page/insertable";
import { fakePage } from "../../fake_page";

const BOX: Insertable = { kind: "shape", name: "box", title: "Box" };

it("is undone even before the server has answered", async () => {
  const page = fakePage();
  const tool = { chosen: signal(null), onPlace: (_thing: Insertable, _point: Vector3): void => undefined };
  Object.assign(page, { tools: { insert: tool, current: signal(null) } });
  const requests: string[] = [];
  let answer = (_: { readonly name: string }): void => undefined;
  vi.spyOn(page.connection, "request").mockImplementation((name) => {
    requests.push(name);
    return new Promise((resolve) => (answer = resolve));
  });
  const insertion = new Insertion({ page, layout: {}, isDrawn: signal(true) } as unknown as InsertionContext);
  expect(insertion.consentRequest.value).toBeNull();
  page.undo.record(
    "Earlier",
    () => undefined,
    () => requests.push("earlier"),
  );

  tool.onPlace(BOX, new Vector3());
  page.undo.undo();
  expect(requests).toEqual(["insert"]);
  answer({ name: "box_0" });
  await vi.waitFor(() => expect(requests).toEqual(["insert", "delete"]));
  expect(page.undo.undoTitle.value).toBe("Earlier");
});
