/** What lies over a camera's picture. */

import { Group as ThreeGroup } from "three";
import { describe, expect, it } from "vitest";

import "../../src/displays/axes";
import "../../src/displays/grid";
import { VisibilityProperty } from "../../src/displays/cameras/visibility";
import { Group } from "../../src/displays/group";
import { fakes } from "./fakes";

const DISPLAYS = [
  { Class: "rviz/Grid", Name: "Grid", Enabled: true },
  {
    Class: "rviz/Group",
    Name: "Parts",
    Enabled: true,
    Displays: [{ Class: "rviz/Axes", Name: "Axes", Enabled: true }],
  },
];

function list(): Group {
  const group = new Group(fakes().context);
  group.load({ Displays: DISPLAYS });
  return group;
}

describe("visibility for a camera", () => {
  it("is the file's, before and after its displays appear", () => {
    const { displays } = list();
    const [grid] = displays;
    const visibility = new VisibilityProperty();
    visibility.load({ Grid: false, Parts: { Axes: true, Value: true }, Value: true });
    visibility.follow(displays);
    expect(visibility.hidden(displays)).toEqual([grid?.root]);
    visibility.load({ Grid: true, Value: true });
    expect(visibility.hidden(displays)).toEqual([]);
  });

  it("hides a whole group, or everything", () => {
    const { displays, all } = list();
    const visibility = new VisibilityProperty();
    visibility.follow(displays);
    visibility.load({ Parts: { Value: false } });
    expect(visibility.hidden(displays)).toEqual(all.slice(1).map(({ root }) => root));
    visibility.load(false);
    expect(visibility.hidden(displays)).toEqual(all.map(({ root }) => root));
    expect(visibility.hidden([])).toEqual([]);
    expect(all[0]?.root).toBeInstanceOf(ThreeGroup);
  });

  it("keeps rows of missing displays, and saves a person's changes", () => {
    const { displays } = list();
    const visibility = new VisibilityProperty();
    visibility.load({ Missing: false, Grid: true, Value: true });
    visibility.follow(displays);
    expect(visibility.save()).toEqual({ Missing: false, Grid: true, Value: true });
    const row = visibility.children.find(({ name }) => name === "Parts");
    row?.load({ Axes: false, Value: true });
    expect(visibility.save()).toEqual({ Missing: false, Grid: true, Parts: { Axes: false, Value: true }, Value: true });
    visibility.follow([]);
    expect(visibility.children).toEqual([]);
  });
});
