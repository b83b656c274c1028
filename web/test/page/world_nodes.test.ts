import { describe, expect, it } from "vitest";

import { keyOf, visibleNodes, worldNode } from "../../src/page/world_nodes";
import { MANIFEST } from "../harness/manifest";

const labels = (search: string, open = true): string[] =>
  visibleNodes(worldNode(MANIFEST), () => open, search).map(({ node, depth }) => `${"  ".repeat(depth)}${node.label}`);

describe("the world's tree", () => {
  it("has models, their groups, sensors below their link, and lights", () => {
    const all = labels("");
    expect(all.slice(0, 4)).toEqual(["rp2w_at_home", "  rp2w", "    Links", "      chassis"]);
    expect(all).toContain("        netbook_webcam");
    expect(all.slice(-3)).toEqual(["  Lights", "    sun", "    lamp"]);
    expect(labels("", false)).toEqual(["rp2w_at_home"]);
  });

  it("keeps the ancestors and children of search matches", () => {
    expect(labels("webcam")).toEqual(["rp2w_at_home", "  rp2w", "    Links", "      body", "        netbook_webcam"]);
    expect(labels("ball")).toEqual(["rp2w_at_home", "  ball", "    Links", "      link"]);
    expect(labels("nothing")).toEqual([]);
  });

  it("begins with the robot", () => {
    const { models } = MANIFEST;
    const tree = worldNode({ ...MANIFEST, models: [...models.slice(1), ...models.slice(0, 1)] });
    expect(tree.children.slice(0, 2).map(({ label }) => label)).toEqual(["rp2w", "living_room"]);
  });

  it("names nested models in full", () => {
    const [robot] = MANIFEST.models;
    const nested = {
      ...MANIFEST,
      models: [{ ...MANIFEST.models[2], name: "outer", models: robot === undefined ? [] : [robot] }],
    } as typeof MANIFEST;
    const keys = visibleNodes(worldNode(nested), () => true, "chassis").map(({ node }) => node.key);
    expect(keys).toContain(keyOf({ kind: "link", model: "outer::rp2w", link: "chassis" }));
  });
});
