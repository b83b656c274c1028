// @vitest-environment jsdom
/** Every .rviz file of the corpus of public robots, where it is there. */

import { existsSync, globSync, readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { parse } from "yaml";
import { describe, expect, it } from "vitest";

import "../../src/displays/all";
import type { Display } from "../../src/displays/display";
import { DisplayStore } from "../../src/displays/display_store";
import { Group } from "../../src/displays/group";
import { displayClass } from "../../src/displays/registry";
import { isMapping, type Yaml, type YamlMapping } from "../../src/rviz/properties";
import { FakeUndo, setup } from "../displays/support";

const CORPUS = join(import.meta.dirname, "../../../../shared/corpus/repos");
const FILES = existsSync(CORPUS) ? globSync("**/*.rviz", { cwd: CORPUS }).sort() : [];

/** Displays of the 46 files that are shown, and those of MoveIt and the like, which are listed with the reason. */
const SHOWN = 314;
const OTHERS = 3;

function allOf(displays: readonly Display[]): readonly Display[] {
  return displays.flatMap((display) => [display, ...(display instanceof Group ? allOf(display.displays) : [])]);
}

const loaded = new Map<string, ReturnType<typeof load>>();

/** A file, loaded once. */
function loadFile(name: string): ReturnType<typeof load> {
  const file = loaded.get(name) ?? load(readFileSync(join(CORPUS, name), "utf8"));
  loaded.set(name, file);
  return file;
}

function load(text: string): { store: DisplayStore; faults: readonly string[] } {
  let [views, tools]: [YamlMapping, readonly YamlMapping[]] = [{}, []];
  const store = new DisplayStore({
    ...setup().context,
    undo: new FakeUndo(),
    views: { save: () => views, load: (yaml) => ((views = yaml), []) },
    tools: { save: () => tools, load: (yaml) => ((tools = yaml), []) },
  });
  return { store, faults: store.load(text) };
}

/** Paths at which the saved file lacks or changes what the original says. */
function lost(before: Yaml, after: Yaml | undefined, path = ""): string[] {
  if (isMapping(before)) {
    if (!isMapping(after)) return [path];
    return Object.entries(before).flatMap(([key, value]) => lost(value, after[key], `${path}/${key}`));
  }
  if (Array.isArray(before)) {
    if (!Array.isArray(after)) return [path];
    return before.flatMap((value: Yaml, index) => lost(value, after[index] as Yaml | undefined, `${path}/${index}`));
  }
  return before === after || (before === null && after === "")
    ? []
    : [`${path}: ${JSON.stringify(before)} → ${JSON.stringify(after)}`];
}

describe.skipIf(FILES.length === 0)("the corpus' .rviz files (skipped where ../shared/corpus is absent)", () => {
  it("are complete", () => {
    expect(FILES).toHaveLength(46);
  });

  it.each(FILES)("%s loads and is saved without loss", (name) => {
    const text = readFileSync(join(CORPUS, name), "utf8");
    const { store, faults } = loadFile(name);
    expect(faults).toEqual([]);
    expect(store.changes.value).toBe(0);
    const saved = store.save();
    expect(lost(parse(text) as Yaml, parse(saved) as Yaml), basename(name)).toEqual([]);
    expect(load(saved).store.save()).toBe(saved);
  });

  it("are shown completely: rviz's displays with all their saved properties", () => {
    const files = FILES.map((name) => {
      const { store } = loadFile(name);
      return { shown: allOf(store.displays.value), refused: store.unsupported.value.map(({ className }) => className) };
    });
    const shown = files.flatMap((file) => file.shown);
    const refused = files.flatMap((file) => file.refused);
    expect(refused.filter((name) => name.startsWith("rviz/"))).toEqual([]);
    const unknown = new Set(
      shown.flatMap((display) => Object.keys(display.unknown).map((key) => `${display.className}: ${key}`)),
    );
    expect([...unknown].sort()).toEqual([
      "moveit_rviz_plugin/MotionPlanning: MoveIt_Goal_Tolerance", // of MoveIt in ROS Hydro
      "moveit_rviz_plugin/MotionPlanning: MoveIt_Warehouse_Host", // there is no warehouse
      "moveit_rviz_plugin/MotionPlanning: MoveIt_Warehouse_Port",
      "rviz/Odometry: Color", // of rviz in ROS Hydro; Noetic's knows neither
      "rviz/Odometry: Length",
    ]);
    expect([shown.length, refused.length]).toEqual([SHOWN, OTHERS]);
  });

  it("contain rviz's displays, which are all supported", () => {
    const names = new Set(
      FILES.flatMap((name) => readFileSync(join(CORPUS, name), "utf8").match(/(?<=Class: )rviz\/\w+/g) ?? []),
    );
    const others = new Set(
      [
        "Displays",
        "Selection",
        "Tool Properties",
        "Views",
        "Time",
        "Help",
        "Tool",
        "Interact",
        "MoveCamera",
        "Select",
        "FocusCamera",
        "Measure",
        "SetInitialPose",
        "SetGoal",
        "PublishPoint",
        "Orbit",
        "XYOrbit",
        "TopDownOrtho",
        "ThirdPersonFollower",
        "FPS",
      ].map((short) => `rviz/${short}`),
    );
    expect([...names].filter((name) => !others.has(name) && displayClass(name) === undefined)).toEqual([]);
  });
});
