// @vitest-environment jsdom
import { signal } from "@preact/signals";
import { describe, expect, it, vi } from "vitest";

import { liveSession } from "../../src/page/session";
import { Shell } from "../../src/app/shell";
import { startDisplays } from "../../src/app/start";
import { PlotsState } from "../../src/panels/plots/plots_state";
import { FakeConnection } from "../fake_connection";
import { changeSession, fakePage, SESSION, type FakePage } from "../fake_page";

const shellOf = (page: FakePage): Shell => new Shell(page, page.commands, document.createElement("div"), signal(false));
const file = (text: string) => ({ rviz: { name: "a.rviz", text, writable: true, saved: false } });

describe("a session that changes", () => {
  it("adds curves once, and names another topic to drive", () => {
    const page = fakePage({ kind: "graph", plots: ["/a/x"] });
    const plots = new PlotsState(page);
    page.connection.listen("/base/cmd_vel", "geometry_msgs/Twist");
    changeSession(page, { plots: ["/a/x", "/b/y"], drive_topic: "/base/cmd_vel" });
    changeSession(page, { title: "another" });
    expect(plots.curves.map((curve) => curve.path)).toEqual(["/a/x", "/b/y"]);
    expect([page.drive.topic.value, page.session.title]).toEqual(["/base/cmd_vel", "another"]);
  });

  it("loads another file and frame, unless a person has changed or saved the displays", () => {
    const page = fakePage({ kind: "graph", ...file("one") });
    startDisplays(shellOf(page));
    const { displays } = page;
    const load = vi.spyOn(displays, "load");
    changeSession(page, { ...file("two"), fixed_frame: "odom" });
    expect([load.mock.lastCall, displays.fixedFrameSetting.value]).toEqual([["two"], "odom"]);
    changeSession(page, { panels: ["rqt_graph"] });
    changeSession(page, file(displays.save()));
    displays.changes.value = 1;
    changeSession(page, file("three"));
    expect(load.mock.calls).toHaveLength(1);
  });

  it("of another kind calls onOther", () => {
    const connection = new FakeConnection();
    const reload = vi.fn();
    const session = liveSession(SESSION, connection, reload);
    const payload = new TextEncoder().encode(JSON.stringify({ ...SESSION, kind: "bag" }));
    connection.receiveRaw("trundle/session", new DataView(payload.buffer));
    expect([reload.mock.calls.length, session.value.kind]).toEqual([1, "simulation"]);
  });

  it("of another version calls onOther, even if the rest cannot be read", () => {
    const connection = new FakeConnection();
    const reload = vi.fn();
    liveSession(SESSION, connection, reload);
    const payload = new TextEncoder().encode(JSON.stringify({ kind: SESSION.kind, version: "9", mood: "sunny" }));
    connection.receiveRaw("trundle/session", new DataView(payload.buffer));
    expect(reload).toHaveBeenCalledOnce();
  });
});
