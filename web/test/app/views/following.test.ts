// @vitest-environment jsdom
import { expect, it } from "vitest";

import { isFollowing, toggleFollowing } from "../../../src/app/views/following";
import { fakePage } from "../../fake_page";
import { MANIFEST } from "../../harness/manifest";

it("follows the selection, otherwise the robot", () => {
  const page = fakePage();
  const followed: (string | null)[] = [];
  page.views.follow = (target: string | null): void => void followed.push(target);
  page.world.manifest.value = MANIFEST;
  toggleFollowing(page);
  page.selection.value = { kind: "joint", model: "rp2w", joint: "body_camera_base" };
  toggleFollowing(page);
  page.selection.value = { kind: "frame", frame: "odom" };
  toggleFollowing(page);
  expect(isFollowing(page)).toBe(false);
  expect(followed).toEqual(["rp2w::chassis", "rp2w::camera_base", "odom"]);
});

it("follows the base of a graph's robot, and nothing without one", () => {
  const page = fakePage({ kind: "graph", robot: null });
  const followed: (string | null)[] = [];
  page.views.follow = (target: string | null): void => void followed.push(target);
  toggleFollowing(page);
  page.frames.frames.value = ["world"];
  toggleFollowing(page);
  expect(followed).toEqual(["base_link"]);
});
