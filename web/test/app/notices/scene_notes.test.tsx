// @vitest-environment jsdom
/** Notes over the scene. */

import { signal } from "@preact/signals";
import { render } from "preact";
import { act } from "preact/test-utils";
import { expect, it } from "vitest";

import { SceneNotes } from "../../../src/app/notices/scene_notes";
import { Shell } from "../../../src/app/shell";
import { fakePage } from "../../fake_page";
import { MANIFEST } from "../../harness/manifest";

it("says that a world loads until it is drawn", () => {
  const page = fakePage();
  const host = document.createElement("div");
  const shell = new Shell(page, page.commands, document.createElement("div"), signal(false));
  page.world.isDrawn.value = false;
  void act(() => render(<SceneNotes shell={shell} />, host));
  expect(host.textContent).toBe("Loading rp2w_at_home");

  void act(() => {
    page.world.manifest.value = MANIFEST;
    page.world.progress.value = 0.4;
  });
  expect(host.textContent).toBe(`Loading ${MANIFEST.name}40 %`);
  void act(() => {
    page.world.progress.value = 1;
  });
  expect(host.textContent).toBe(`Loading ${MANIFEST.name}100 %`);
  void act(() => {
    page.world.isDrawn.value = true;
  });
  expect(host.textContent).toBe("");
});
