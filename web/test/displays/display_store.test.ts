import { describe, expect, it } from "vitest";

import "../../src/displays/axes";
import "../../src/displays/grid";
import { Display } from "../../src/displays/display";
import { DisplayStore } from "../../src/displays/display_store";
import { workOutFixedFrame } from "../../src/displays/fixed_frame";
import { Group, withMembers } from "../../src/displays/group";
import { TopicProperty, type YamlMapping } from "../../src/rviz/properties";
import { register } from "../../src/displays/registry";
import { FakeUndo, setup, type Setup } from "./support";

class Probe extends Display {
  readonly className = "rviz/Probe";
  readonly topicProperty = this.add(new TopicProperty("Probe Topic", "", ["probe_msgs/Probe"]));
  starts = 0;
  updates = 0;
  running = false;

  override get topic(): string {
    return this.context.names.resolve(this.topicProperty.value.value);
  }

  protected onStart(): void {
    this.starts++;
    this.running = true;
  }

  protected onStop(): void {
    this.running = false;
  }

  override update(): void {
    if (this.name.peek() === "Broken") throw new Error("no such field");
    this.updates++;
  }
}

register({
  className: "rviz/Probe",
  aliases: [],
  types: ["probe_msgs/Probe"],
  create: (context) => new Probe(context),
});

interface StoreSetup extends Setup {
  readonly store: DisplayStore;
  readonly undo: FakeUndo;
}

function makeStore(): StoreSetup {
  const base = setup();
  const undo = new FakeUndo();
  const views = { save: (): YamlMapping => ({}), load: () => [] };
  const tools = { save: () => [], load: () => [] };
  return { ...base, undo, store: new DisplayStore({ ...base.context, undo, views, tools }) };
}

function file(displays: string): string {
  return `Visualization Manager:\n  Displays:\n${displays}`;
}

describe("the list", () => {
  it("adds, removes, moves and duplicates, and each can be undone", () => {
    const { store, undo } = makeStore();
    store.load(file("    []\n"));
    const probe = store.add("rviz/Probe", "/probe");
    const grid = store.add("rviz/Grid");
    const names = (): string[] => store.displays.value.map((display) => display.name.value);
    store.move(grid, 0);
    expect(names()).toEqual(["Grid", "Probe"]);
    const copy = store.duplicate(probe);
    expect(names()).toEqual(["Grid", "Probe", "Copy of Probe"]);
    expect(copy.topic).toBe("/probe");
    store.remove(probe);
    for (const expected of [["Grid", "Probe", "Copy of Probe"], ["Grid", "Probe"], ["Probe", "Grid"], ["Probe"], []]) {
      undo.undo();
      expect(names()).toEqual(expected);
    }
    undo.redo();
    expect(names()).toEqual(["Probe"]);
  });

  it("draws the scene again when a display is removed or disabled", () => {
    const { store, scene } = makeStore();
    store.load(file("    []\n"));
    const probe = store.add("rviz/Probe");
    const grid = store.add("rviz/Grid");
    const before = scene.frames;
    store.remove(probe);
    expect(scene.frames).toBeGreaterThan(before);
    const removed = scene.frames;
    grid.enabled.decode(false);
    expect(scene.frames).toBeGreaterThan(removed);
  });

  it("starts enabled displays, in groups only while the group is enabled", () => {
    const { store } = makeStore();
    store.load(
      file(`
    - Class: rviz/Group
      Name: Robot
      Enabled: true
      Displays:
        - Class: rviz/Probe
          Name: First
          Enabled: true
        - Class: rviz/Probe
          Name: Second
          Enabled: false
`),
    );
    const group = store.displays.value[0] as Group;
    const [first, second] = group.displays.filter((display) => display instanceof Probe);
    if (first === undefined || second === undefined) throw new Error("two probes");
    expect([first.running, second.running]).toEqual([true, false]);
    group.enabled.value.value = false;
    expect(first.running).toBe(false);
    second.enabled.value.value = true;
    expect(second.running).toBe(false);
    group.enabled.value.value = true;
    expect([first.running, second.running, first.starts]).toEqual([true, true, 2]);
  });

  it("continues when a display throws, also in groups", () => {
    const { store } = makeStore();
    store.load(
      file(`
    - Class: rviz/Group
      Enabled: true
      Displays: [{Class: rviz/Probe, Name: Broken, Enabled: true}, {Class: rviz/Probe, Name: Sound, Enabled: true}]
`),
    );
    store.update(0n, 0.1);
    const [, broken, sound] = withMembers(store.displays.value);
    expect([broken?.level, [...(broken?.statuses.value.values() ?? [])][0]?.text]).toEqual([
      "error",
      "It cannot be drawn: no such field",
    ]);
    expect((sound as Probe).updates).toBe(1);
  });

  it("reads whether a display is on from Enabled, else Value, else off", () => {
    const { store } = makeStore();
    store.load(
      file(`
    - {Class: rviz/Probe, Enabled: true}
    - {Class: rviz/Probe, Value: true}
    - {Class: rviz/Probe}
`),
    );
    expect(store.displays.value.map((display) => display.enabled.value.value)).toEqual([true, true, false]);
  });

  it("lists unsupported displays with the reason, and keeps them in the file", () => {
    const { store } = makeStore();
    store.load(
      file(`
    - Class: jsk_rviz_plugins/OverlayText
      Name: Text
      Font: large # ours
    - Class: rviz/Probe
      Name: Probe
`),
    );
    expect(store.unsupported.value[0]).toMatchObject({
      className: "jsk_rviz_plugins/OverlayText",
      reason:
        "a plugin of jsk_rviz_plugins; only rviz's and MoveIt's displays and octomap's OccupancyGrid are shown here",
    });
    expect(store.save()).toContain("Font: large # ours");
  });

  it("offers the topics that no display shows, not even one in a group", () => {
    const { store, connection } = makeStore();
    store.load(file("    - {Class: rviz/Group, Displays: [{Class: rviz/Probe, Probe Topic: shown}]}\n"));
    for (const name of ["/shown", "/other"]) connection.advertise(name, "probe_msgs/Probe");
    connection.advertise("/text", "std_msgs/String");
    expect(store.offers.value.map((offer) => [offer.topic.name, offer.className])).toEqual([["/other", "rviz/Probe"]]);
    store.add("rviz/Probe", "/other");
    expect(store.offers.value).toEqual([]);
  });

  it("counts a person's edits since it was saved, and no automatic changes", () => {
    const { store, undo } = makeStore();
    const { value } = store.backgroundColor;
    const paint = (): void =>
      store.edit(
        "Change",
        () => (value.value = [0, 0, 0]),
        () => (value.value = [48, 48, 48]),
      );
    value.value = [1, 2, 3];
    expect(store.changes.value).toBe(0);
    paint();
    paint();
    expect(store.changes.value).toBe(2);
    undo.undo();
    expect(store.changes.value).toBe(1);
    undo.redo();
    expect(store.save()).toContain("Background Color: 0; 0; 0");
    store.markSaved();
    expect(store.changes.value).toBe(0);
    undo.undo();
    expect(store.changes.value).toBe(1);
    paint();
    expect(store.changes.value).toBe(2);
  });

  it("starts with the registered ones of grid, robot and tf", () => {
    const { store } = makeStore();
    expect(store.displays.value.map((display) => display.className)).toContain("rviz/Grid");
  });
});

describe("the fixed frame", () => {
  it("is the one that is set, without tf's slash", () => {
    const { store } = makeStore();
    store.fixedFrameSetting.value = "/base_link";
    expect(store.fixedFrame.value).toBe("base_link");
    expect(store.fixedFrameStatus.value).toMatchObject({
      level: "error",
      text: "Fixed Frame [base_link] does not exist",
    });
  });

  it("is computed again when frames appear", () => {
    const { store, frames } = makeStore();
    frames.forget("map");
    frames.set("base_link", "odom");
    frames.set("wheel", "base_link");
    expect(store.fixedFrame.value).toBe("odom");
    frames.set("odom", "map");
    expect(store.fixedFrame.value).toBe("map");
  });

  const tree = (...pairs: readonly (readonly [string, string | null])[]): string =>
    workOutFixedFrame(
      pairs.map(([name, parent]) => ({ name, parent, isStatic: false, stamp: 0n, rate: null, publisher: null })),
    );

  it("is map below utm, the root if no frame has a fixed name, and map without frames", () => {
    expect(tree(["utm", null], ["map", "utm"], ["odom", "map"], ["base", "odom"])).toBe("map");
    expect(tree(["torso", null], ["head", "torso"])).toBe("torso");
    expect(tree()).toBe("map");
  });

  it("is of the largest tree", () => {
    expect(tree(["world", null], ["camera", "world"], ["odom", null], ["base", "odom"], ["wheel", "base"])).toBe(
      "odom",
    );
  });
});
