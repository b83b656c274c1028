// @vitest-environment jsdom
import { describe, expect, test } from "vitest";

import { Curve } from "../../src/panels/plots/curve";
import { legendText } from "../../src/panels/plots/legend";
import { paddedRange } from "../../src/panels/plots/plot";
import { PlotsState } from "../../src/panels/plots/plots_state";
import { valueOwners } from "../../src/panels/plots/simulated_values";
import { fakePage } from "../fake_page";
import { MANIFEST } from "../harness/manifest";

const at = (sec: number): { header: { stamp: { sec: number; nsec: number } } } => ({
  header: { stamp: { sec, nsec: 0 } },
});

describe("the legend", () => {
  test.each([
    [0.31, 0.5, "0.310"],
    [-1.9e-10, 0.5, "0.000"],
    [-1.9e-10, 1.9e-10, "−1.9e−10"],
    [-12.5, 20, "−12.50"],
  ])("writes %f beside at most %f as %s", (value, largest, text) => {
    expect(legendText(value, largest)).toBe(text);
  });
});

describe("the axis of values", () => {
  test.each([
    [
      [0, 2],
      [-0.2, 2.2],
    ],
    [
      [5, 5],
      [4.5, 5.5],
    ],
    [
      [0, -1.5e-7],
      [-1.015e-5, 1e-5],
    ],
  ])("shows %j in %j", (values, range) => {
    const [min, max] = paddedRange([new Float64Array(values)]);
    expect([min.toPrecision(4), max.toPrecision(4)]).toEqual(range.map((end) => end.toPrecision(4)));
  });
});

describe("a curve", () => {
  test("uses the stamp if there is one, otherwise the time of receipt", () => {
    const page = fakePage();
    page.connection.advertise("/odom", "nav_msgs/Odometry");
    const [stamped, plain] = [new Curve(page, "/odom/twist/twist/linear/x"), new Curve(page, "/speed.data")];
    page.connection.receive("/odom", { ...at(7), twist: { twist: { linear: { x: 0.5 } } } }, { time: 99_000_000_000n });
    page.connection.receive("/speed", { data: 3 }, { time: 8_000_000_000n });
    expect([stamped.points.lastX, stamped.points.lastY, stamped.unit.value]).toEqual([7, 0.5, "m/s"]);
    expect([plain.points.lastX, plain.points.lastY]).toEqual([8, 3]);
    expect([stamped.name, stamped.caption]).toEqual(["linear.x", "/odom twist.twist"]);
  });

  test("reports why nothing is drawn", () => {
    const page = fakePage();
    const curve = new Curve(page, "/odom.twist.z");
    expect(curve.fault.value).toBe("No message yet");
    page.connection.receive("/odom", { twist: { x: 1, y: 2 } });
    expect(curve.fault.value).toBe("There is no z; fields here: x, y");
    const list = new Curve(page, "/scan.ranges");
    page.connection.receive("/scan", { ranges: [1, 2] });
    expect(list.fault.value).toBe("This is a list of 2; choose one, as [0]");
    expect(new Curve(fakePage({ kind: "graph" }), "nonsense").fault.value).toBe(
      "Not a path; example: /odom.twist.twist.linear.x",
    );
  });

  test("holds a command until the next one, and the last one until the end", () => {
    const page = fakePage({ plots: ["/odom.x", "/cmd_vel.linear.x"] });
    const state = new PlotsState(page);
    const [measured, commanded] = state.curves;
    const command = (x: number, time: bigint): void =>
      page.connection.receive("/cmd_vel", { linear: { x } }, { time: time * 1_000_000_000n });
    page.connection.receive("/odom", { ...at(10), x: 0 });
    command(0, 10n);
    command(1, 20n);
    page.connection.receive("/odom", { ...at(40), x: 1 });
    expect([measured?.isHeld.value, commanded?.isHeld.value]).toEqual([false, true]);
    const lines = [...state.svg().matchAll(/points="([^"]*)"/g)].map(([, points = ""]) =>
      points.split(" ").map((point) => point.split(",").map(Number)),
    );
    const [ramp = [], steps = []] = lines;
    expect([ramp.length, steps.length]).toEqual([2, 4]);
    const [first, before, second, end] = steps;
    expect([before?.[1], before?.[0]]).toEqual([first?.[1], second?.[0]]);
    expect([end?.[1], end?.[0]]).toEqual([second?.[1], ramp.at(-1)?.[0]]);
  });

  test("uses its topic once it is known, and drops the guessed one", () => {
    const page = fakePage();
    const curve = new Curve(page, "/a/b/c");
    expect(page.connection.subscriptions("/a/b")).toBe(1);
    page.connection.advertise("/a", "test/A");
    expect([page.connection.subscriptions("/a/b"), page.connection.subscriptions("/a")]).toEqual([0, 1]);
    curve.close();
    expect(page.connection.subscriptions("/a")).toBe(0);
  });

  test("asks for a value of a simulation or a played log by its name", () => {
    for (const kind of ["simulation", "log"] as const) {
      const page = fakePage({ kind });
      const curve = new Curve(page, "rp2w::camera_base_camera.velocity");
      expect(page.connection.requests.at(-1)).toEqual({ name: "plot", fields: { series: [curve.path] } });
      expect([curve.name, curve.caption]).toEqual(["camera_base_camera.velocity", "rp2w"]);
    }
  });

  test("can be of what a log has", () => {
    const [simulated, recorded, none] = (["simulation", "log", "graph"] as const).map((kind) =>
      valueOwners(MANIFEST, kind).flatMap(({ values }) => values),
    );
    expect(simulated).toEqual(expect.arrayContaining(recorded ?? []));
    const paths = ["rp2w.pose.x", "rp2w::chassis.twist.angular.z", "rp2w::camera_base_camera.velocity"];
    expect(recorded).toEqual(expect.arrayContaining(paths));
    expect(recorded?.filter((path) => /contact|effort|living_room/.test(path))).toEqual([]);
    expect(none).toEqual([]);
  });
});

describe("a curve of the simulation", () => {
  const PATH = "rp2w::chassis.pose.x";
  /** Rows of a time and a value. */
  const message = (
    first: number,
    rows: readonly (readonly [number, number])[],
    faults: Record<string, string> = {},
  ): DataView => {
    const head = new TextEncoder().encode(
      JSON.stringify({ names: rows.length > 0 ? [PATH] : [], units: ["m"], faults }),
    );
    const view = new DataView(new ArrayBuffer(12 + head.length + 16 * rows.length));
    view.setBigUint64(0, BigInt(first), true);
    view.setUint32(8, head.length, true);
    new Uint8Array(view.buffer).set(head, 12);
    rows.flat().forEach((value, index) => view.setFloat64(12 + head.length + 8 * index, value, true));
    return view;
  };

  test("is subscribed while shown, and receives each row once", () => {
    const page = fakePage();
    const curve = new Curve(page, PATH);
    expect(page.connection.requests.at(-1)).toEqual({ name: "plot", fields: { series: [PATH] } });
    page.connection.receiveRaw(
      "trundle/series",
      message(4, [
        [1, 10],
        [2, 20],
      ]),
    );
    page.connection.receiveRaw(
      "trundle/series",
      message(5, [
        [2, 20],
        [3, 30],
      ]),
    );
    expect(curve.points.between(-Infinity, Infinity).map((part) => [...part])).toEqual([
      [1, 2, 3],
      [10, 20, 30],
    ]);
    expect([curve.unit.value, curve.fault.value]).toEqual(["m", ""]);
    curve.close();
    expect(page.connection.requests.at(-1)).toEqual({ name: "plot", fields: { series: [] } });
  });

  test("drops later points when time goes back", () => {
    const page = fakePage();
    const curve = new Curve(page, PATH);
    page.connection.receiveRaw(
      "trundle/series",
      message(0, [
        [1, 10],
        [2, 20],
        [3, 30],
      ]),
    );
    page.connection.receiveRaw("trundle/series", message(3, [[1.5, 15]]));
    expect(curve.points.between(-Infinity, Infinity).map((part) => [...part])).toEqual([
      [1, 1.5],
      [10, 15],
    ]);
  });

  test("reports why there are no values", () => {
    const page = fakePage();
    const curve = new Curve(page, PATH);
    page.connection.receiveRaw("trundle/series", message(0, [], { [PATH]: "it is not there" }));
    expect(curve.fault.value).toBe("it is not there");
  });
});

describe("plots", () => {
  test("open the session's plots; x:y are two curves", () => {
    const state = new PlotsState(fakePage({ plots: ["/pose/x:y", "/speed/data"] }));
    expect(state.curves.map((curve) => curve.path)).toEqual(["/pose/x", "/pose/y", "/speed/data"]);
  });

  test("a suggested curve has its own name", () => {
    const state = new PlotsState(fakePage());
    state.add("/cmd_vel/linear/x", "commanded");
    expect(state.curves.map(({ name, caption }) => [name, caption])).toEqual([["commanded", "/cmd_vel/linear/x"]]);
  });

  test("a curve moves into a plot of its own, and back; empty plots are removed", () => {
    const state = new PlotsState(fakePage({ plots: ["/a.x", "/b.x"] }));
    const [, second] = state.curves;
    if (second === undefined) throw new Error("no curve");
    state.separate(second);
    expect(state.plots.value.map((plot) => plot.curves.length)).toEqual([1, 1]);
    state.move(second, 0);
    expect(state.plots.value.map((plot) => plot.curves.length)).toEqual([2]);
    state.remove(second);
    expect(state.curves.map((curve) => curve.path)).toEqual(["/a.x"]);
  });

  test("show the newest seconds; paused ones stay, and the points go on", () => {
    const page = fakePage({ plots: ["/a.x"] });
    const state = new PlotsState(page);
    const receive = (x: number): void => page.connection.receive("/a", { x }, { time: BigInt(x) * 1_000_000_000n });
    receive(40);
    state.pause(true);
    receive(60);
    expect(state.range()).toEqual([10, 40]);
    state.pause(false);
    expect(state.range()).toEqual([30, 60]);
    expect(state.csv()).toBe("time,/a.x\n40,40\n60,60\n");
  });
});
