/** Names as roscpp resolves them. */

import { expect, it } from "vitest";

import { GraphNames } from "../../src/protocol/graph_names";

it("resolves relative names in the namespace", () => {
  const names = new GraphNames("/fleet/one");
  expect(names.resolve("scan")).toBe("/fleet/one/scan");
  expect(names.resolve("/scan")).toBe("/scan");
  expect(new GraphNames().resolve("scan")).toBe("/scan");
  expect(names.resolve("")).toBe("");
});

it("remaps global names", () => {
  const names = new GraphNames("/one", { "/one/scan": "/laser", "/map": "/one/map" });
  expect(names.resolve("scan")).toBe("/laser");
  expect(names.resolve("/one/scan")).toBe("/laser");
  expect(names.resolve("/map")).toBe("/one/map");
  expect(names.resolve("constructor")).toBe("/one/constructor");
});

it("searches parameters upwards", () => {
  const names = new GraphNames("/fleet/one", { "/fleet/one/robot_description": "/spare" });
  expect(names.search("robot_description")).toEqual(["/spare", "/fleet/robot_description", "/robot_description"]);
  expect(names.search("/robot_description")).toEqual(["/robot_description"]);
  expect(new GraphNames().search("robot_description")).toEqual(["/robot_description"]);
});
