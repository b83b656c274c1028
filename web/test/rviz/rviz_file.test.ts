import { parse } from "yaml";
import { describe, expect, it } from "vitest";

import { isMapping, type Yaml, type YamlMapping } from "../../src/rviz/properties";
import { DEFAULT_FILE, RvizFile, RvizFileError } from "../../src/rviz/rviz_file";

const FILE = `# made by hand
Panels:
  - Class: rviz/Displays
    Help Height: 78
Visualization Manager:
  Displays:
    - Alpha: 0.030  # thin
      Class: rviz_default_plugins/Grid
      Name: Ground
      Strange: {a: [1, 2]}
      Topic:
        Depth: 5
        Durability Policy: Volatile
        Value: /map
    - Class: rviz/Axes
      Name: Axes
  Global Options:
    Fixed Frame: map
  Tools:
    - Class: rviz_default_plugins/MoveCamera
  Views:
    Current:
      Class: rviz_default_plugins/Orbit
      Value: Orbit (rviz_default_plugins)
    Saved: ~
Window Geometry:
  Height: 800
  QMainWindow State: 000000ff00000000fd
`;

function grid(alpha: number, topic: string): YamlMapping {
  return { Class: "rviz/Grid", Name: "Ground", Alpha: alpha, Topic: topic, Strange: { a: [1, 2] } };
}

describe("an .rviz file", () => {
  it("is written unchanged without edits", () => {
    const file = RvizFile.parse(FILE);
    const content = file.content();
    const written = file.write({ ...content, displays: [grid(0.03, "/map"), { Class: "rviz/Axes", Name: "Axes" }] });
    expect(written).toBe(FILE.replace("  # thin", " # thin").replace("{a: [1, 2]}", "{ a: [ 1, 2 ] }"));
  });

  it("keeps comments, order and unknown entries around a change", () => {
    const file = RvizFile.parse(FILE);
    const displays = [{ Class: "rviz/Axes", Name: "Axes", Length: 2 }, grid(0.5, "/other")];
    const written = file.write({ ...file.content(), displays });
    expect(written).toContain("# made by hand");
    expect(written).toContain("Alpha: 0.5 # thin");
    expect(written).toContain("Class: rviz_default_plugins/Grid");
    expect(written).toContain("QMainWindow State: 000000ff00000000fd");
    const manager = (parse(written) as YamlMapping)["Visualization Manager"] as YamlMapping;
    const [axes, ground] = manager["Displays"] as readonly YamlMapping[];
    expect(axes).toEqual({ Class: "rviz/Axes", Name: "Axes", Length: 2 });
    expect(ground?.["Topic"]).toEqual({ Depth: 5, "Durability Policy": "Volatile", Value: "/other" });
  });

  it("names views and tools of ROS 2 as ROS 1 does", () => {
    const { views, tools } = RvizFile.parse(FILE).content();
    expect(views["Current"]).toEqual({ Class: "rviz/Orbit", Value: "Orbit (rviz)" });
    expect(tools).toEqual([{ Class: "rviz/MoveCamera" }]);
  });

  it("reads the word Y as text, not as a boolean", () => {
    const file = RvizFile.parse("Visualization Manager:\n  Displays:\n    - {Axis: Y, Offset: {X: 1, Y: 2, Z: 3}}\n");
    const display: Yaml | undefined = file.content().displays[0];
    expect(isMapping(display) && display["Axis"]).toBe("Y");
  });

  it("is refused with a sentence if it is a .vcg, not YAML, or another file", () => {
    const refusal = (text: string): string => {
      try {
        RvizFile.parse(text);
      } catch (error) {
        if (error instanceof RvizFileError) return error.message;
        throw error;
      }
      return "";
    };
    expect(refusal("Background\\ ColorR=0.1\n[Display0]\nName=Grid\n")).toMatch(/\.vcg file of rviz before ROS Groovy/);
    expect(refusal("a: [1\n")).toMatch(/^The \.rviz file is not YAML: /);
    expect(refusal("a: *nowhere\n")).toMatch(/^The \.rviz file is not YAML: /);
    const bomb = ["a0: &a0 [x, x]", ...Array.from({ length: 30 }, (_, i) => `a${i + 1}: &a${i + 1} [*a${i}, *a${i}]`)];
    expect(refusal(bomb.join("\n"))).toMatch(/^The \.rviz file is not YAML: /);
    expect(refusal("[".repeat(100_000))).toMatch(/^The \.rviz file is not YAML: /);
    expect(refusal("Panels: []\n")).toBe('The file has no "Visualization Manager", which every .rviz file has.');
  });

  it("has a valid default file", () => {
    expect(RvizFile.parse(DEFAULT_FILE).content().displays).toHaveLength(3);
  });
});
