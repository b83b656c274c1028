// @vitest-environment jsdom
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";

import { JointsState, shownUnit } from "../../src/panels/joints/joint_sliders";
import { AT_REST, joyFromGamepad } from "../../src/panels/joystick/gamepad_axes";
import { JoystickState } from "../../src/panels/joystick/joystick_state";
import { ReconfigureServer, serverNames } from "../../src/panels/reconfigure/reconfigure_server";
import { rulerTimes, TimelineState } from "../../src/panels/timeline/timeline_state";
import { Publication } from "../../src/panels/topics/publication";
import { fakePage } from "../fake_page";
import { MANIFEST } from "../harness/manifest";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

describe("publishing", () => {
  test("publishes once and at a rate, and refuses an invalid field", async () => {
    const { connection } = fakePage();
    connection.definitions.set("std_msgs/Int8", "int8 data\n");
    const publication = new Publication(connection, "/n", "std_msgs/Int8");
    await vi.advanceTimersByTimeAsync(0);
    publication.form.value?.set("data", "5");
    publication.once();
    expect(connection.published).toEqual([{ topic: "/n", type: "std_msgs/Int8", message: { data: 5 } }]);
    publication.setRate(20);
    publication.start();
    vi.advanceTimersByTime(200);
    expect(connection.published.length).toBe(6);
    publication.form.value?.set("data", "500");
    vi.advanceTimersByTime(200);
    expect([connection.published.length, publication.isRunning.value, publication.fault.value]).toEqual([
      6,
      false,
      "data must be a whole number from -128 to 127",
    ]);
  });

  test("an unknown type is reported", async () => {
    const publication = new Publication(fakePage().connection, "/n", "no/Such");
    await vi.advanceTimersByTimeAsync(0);
    expect(publication.fault.value).toBe("there is no type no/Such");
  });
});

describe("joints", () => {
  test("sliders of the session and of the world request the set position", () => {
    const page = fakePage({ sliders: [{ name: "arm", lower: -1, upper: 2, position: 0.5 }] });
    page.world.manifest.value = MANIFEST;
    const state = new JointsState(page);
    const [gui, robot] = state.groups();
    expect(gui?.sliders.map(({ name, position }) => [name, position])).toEqual([["arm", 0.5]]);
    expect(robot?.sliders.map(({ name, hasLimits }) => [name, hasLimits]).slice(0, 2)).toEqual([
      ["body_camera_base", true],
      ["camera_base_camera", true],
    ]);
    gui?.sliders[0]?.set(1);
    robot?.sliders[1]?.set(-0.25);
    expect(page.connection.requests).toEqual([
      { name: "slider", fields: { joint: "arm", position: 1 } },
      { name: "joint", fields: { model: "rp2w", joint: "camera_base_camera", position: -0.25 } },
    ]);
    expect(state.groups()[0]?.sliders[0]?.position).toBe(1);
  });

  test("all to zero stays within the limits", () => {
    const page = fakePage({
      sliders: [
        { name: "a", lower: 1, upper: 2, position: 2 },
        { name: "b", lower: -1, upper: 1, position: 1 },
      ],
    });
    new JointsState(page).allToZero();
    expect(page.connection.requests.map(({ fields }) => fields["position"])).toEqual([1, 0]);
  });

  test("angles are shown in radians or degrees, lengths in metres", () => {
    expect([shownUnit(false, false), shownUnit(true, true)]).toEqual([
      [1, "rad"],
      [1, "m"],
    ]);
    expect(shownUnit(false, true)[0] * Math.PI).toBeCloseTo(180);
  });
});

describe("joystick", () => {
  test("a standard gamepad is mapped to joy's order and signs", () => {
    const buttons = Array.from({ length: 17 }, () => 0);
    expect(joyFromGamepad([0, 0, 0, 0], buttons)).toEqual(AT_REST);
    [buttons[0], buttons[6], buttons[8], buttons[12], buttons[15]] = [1, 0.5, 1, 1, 1];
    const joy = joyFromGamepad([0.5, -1, 0.25, 0], buttons);
    expect(joy.axes).toEqual([-0.5, 1, 0, -0.25, 0, 1, -1, 1]);
    expect(joy.buttons).toEqual([1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0]);
  });

  test("changes are sent, what is held is renewed, and all is released at the end", () => {
    vi.stubGlobal("navigator", { getGamepads: () => [] });
    const { connection } = fakePage();
    const state = new JoystickState(connection);
    state.start();
    vi.advanceTimersByTime(200);
    expect(connection.requests).toEqual([]);
    state.setButton(2, 1);
    state.setAxis(1, 0.5);
    vi.advanceTimersByTime(500);
    state.stop();
    const sent = connection.requests.map(({ fields }) => fields);
    const held = { axes: [0, 0.5, 1, 0, 0, 1, 0, 0], buttons: [0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0] };
    expect(sent).toEqual([held, held, { axes: AT_REST.axes, buttons: AT_REST.buttons }]);
    vi.unstubAllGlobals();
  });
});

describe("dynamic_reconfigure", () => {
  const CONFIG = { bools: [], ints: [], strs: [], doubles: [{ name: "rate", value: 10 }], groups: [] };
  const DESCRIPTION = {
    groups: [
      {
        name: "Default",
        id: 0,
        parent: 0,
        parameters: [{ name: "rate", type: "double", level: 0, description: "", edit_method: "" }],
      },
    ],
    min: CONFIG,
    max: CONFIG,
    dflt: CONFIG,
  };

  test("a change is set, shown as answered, and undone", async () => {
    const page = fakePage();
    page.connection.advertise("/node/parameter_descriptions", "dynamic_reconfigure/ConfigDescription");
    expect(serverNames(page.connection.topics.value)).toEqual(["/node"]);
    page.connection.answers.set("/node/set_parameters", (request) => request);
    const server = new ReconfigureServer(page.connection, page.undo, "/node");
    page.connection.receive("/node/parameter_descriptions", DESCRIPTION);
    const rate = server.groups.value?.[0]?.options[0];
    if (rate === undefined) throw new Error("no option");
    server.change(rate, 25);
    await vi.advanceTimersByTimeAsync(0);
    expect([server.value(rate), page.undo.undoTitle.value]).toEqual([25, "Change of rate"]);
    page.undo.undo();
    const sent = page.connection.calls.map(({ request }) => (request["config"] as typeof CONFIG).doubles[0]?.value);
    expect(sent).toEqual([25, 10]);
    page.connection.receive("/node/parameter_updates", { ...CONFIG, doubles: [{ name: "rate", value: 3 }] });
    expect(server.value(rate)).toBe(3);
  });
});

describe("the timeline", () => {
  test("a recording is seekable, a running simulation is not", () => {
    const page = fakePage();
    const state = new TimelineState(page);
    expect(state.span()).toMatchObject({ start: 0, known: 12.48, isSeekable: false });
    page.world.state.value = {
      time_ns: 2e9,
      paused: true,
      real_time_factor: null,
      speed: 1,
      timeline: { start_ns: 1e9, end_ns: 5e9 },
    };
    expect(state.span()).toEqual({ start: 1, end: 5, known: 5, isSeekable: true });
    state.seek(3.25);
    expect(page.connection.requests).toEqual([{ name: "seek", fields: { time_ns: 3.25e9 } }]);
  });

  test("of several seeks during a request, only the newest is sent", async () => {
    const page = fakePage();
    const state = new TimelineState(page);
    for (const time of [1, 2, 3]) state.seek(time);
    await vi.advanceTimersByTimeAsync(0);
    expect(page.connection.requests.map(({ fields }) => fields["time_ns"])).toEqual([1e9, 3e9]);
  });

  test("lanes contain the joined intervals of messages", () => {
    const page = fakePage();
    page.connection.advertise("/scan", "sensor_msgs/LaserScan");
    const state = new TimelineState(page);
    for (const seconds of [1, 1.25, 1.5, 4]) {
      page.world.state.value = { time_ns: seconds * 1e9, paused: false, real_time_factor: 1, speed: 1 };
      page.connection.receive("/scan", {});
      vi.advanceTimersByTime(200);
    }
    expect(state.topics.all[0]?.bands.map((band) => band.map((time) => Number(time.toFixed(2))))).toEqual([
      [1, 1.55],
      [4, 4.05],
    ]);
  });

  test("lanes of a short recording have no gaps although buckets are shorter than the sampling period", () => {
    const page = fakePage();
    page.connection.advertise("/scan", "sensor_msgs/LaserScan");
    const state = new TimelineState(page);
    for (let tenths = 0; tenths <= 50; tenths += 2) {
      page.world.state.value = {
        time_ns: tenths * 1e8,
        paused: false,
        real_time_factor: 1,
        speed: 1,
        timeline: { start_ns: 0, end_ns: 10e9 },
      };
      page.connection.receive("/scan", {});
      vi.advanceTimersByTime(200);
    }
    expect(state.topics.all[0]?.bands.map(([start, end]) => [start, Number(end.toFixed(2))])).toEqual([[0, 5.05]]);
  });

  test("marks are named, and removed by an empty name", () => {
    const state = new TimelineState(fakePage());
    state.mark();
    const [mark] = state.marks.value;
    if (mark === undefined) throw new Error("no mark");
    state.rename(mark, "hits the ball");
    expect(state.marks.value).toEqual([{ id: 1, time: 12.48, name: "hits the ball" }]);
    state.rename(mark, "");
    expect(state.marks.value).toEqual([]);
  });

  test("the ruler has round times", () => {
    const span = { start: 3, end: 33, known: 33, isSeekable: true };
    expect(rulerTimes(span, 8)).toEqual([5, 10, 15, 20, 25, 30]);
  });
});
