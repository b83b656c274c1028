// @vitest-environment jsdom
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

import { listenToDriveKeys } from "../../src/app/drive/keys";
import { fakePage } from "../fake_page";

describe("driving", () => {
  let stop: () => void;
  const setUp = () => {
    const { drive, connection } = fakePage();
    connection.listen("/cmd_vel", "geometry_msgs/Twist");
    stop = listenToDriveKeys(drive);
    return { drive, connection };
  };
  const press = (key: string, target: EventTarget = document.body, type = "keydown"): boolean =>
    target.dispatchEvent(
      new KeyboardEvent(type, { key, code: `Key${key.toUpperCase()}`, bubbles: true, cancelable: true }),
    );

  beforeEach(() => {
    localStorage.clear();
    Object.defineProperty(navigator, "getGamepads", { value: () => [], configurable: true });
    vi.useFakeTimers();
  });
  afterEach(() => {
    stop();
    vi.useRealTimers();
  });

  it("sends at each key and at 10 Hz while one is held, and releases once at the end", () => {
    const { connection } = setUp();
    press("w");
    press("a");
    vi.advanceTimersByTime(300);
    expect(connection.driven.length).toBe(5);
    expect(connection.driven.at(-1)).toEqual({ topic: "/cmd_vel", linear: 0.5, angular: 1 });
    press("w", document.body, "keyup");
    expect(connection.released).toBe(0);
    press("a", document.body, "keyup");
    vi.advanceTimersByTime(1000);
    expect([connection.driven.length, connection.released]).toEqual([6, 1]);
  });

  it.each(["blur", "pagehide"])("releases at %s", (event) => {
    const { drive, connection } = setUp();
    press("s");
    expect(drive.command.value?.linear).toBe(-0.5);
    dispatchEvent(new Event(event));
    expect([connection.released, drive.command.value]).toEqual([1, null]);
  });

  it("releases when a field takes the focus, and ignores keys in the field", () => {
    const { connection } = setUp();
    const field = document.body.appendChild(document.createElement("input"));
    press("w");
    field.focus();
    field.dispatchEvent(new FocusEvent("focusin", { bubbles: true }));
    expect(connection.released).toBe(1);
    expect(press("d", field)).toBe(true);
    expect(connection.driven.length).toBe(1);
    field.remove();
  });

  it("releases when the connection is lost, and ignores keys until it is back", () => {
    const { drive, connection } = setUp();
    drive.hold("disc", 0.5, 0);
    connection.state.value = { kind: "lost", retryInSeconds: 3 };
    expect(connection.released).toBe(1);
    drive.hold("disc", 0.5, 0);
    expect(drive.command.value).toBeNull();
  });

  it("keeps its topic after a reconnection, while subscribers are still unknown", () => {
    const { connection } = setUp();
    const { graph, topics } = connection;
    press("w");
    press("w", document.body, "keyup");
    graph.value = { types: new Map(), publishers: new Map(), subscribers: new Map(), services: new Map() };
    topics.value = new Map([["/rosout", { name: "/rosout", type: "rosgraph_msgs/Log" } as never]]);
    press("s");
    expect(connection.driven.at(-1)).toMatchObject({ topic: "/cmd_vel", linear: -0.5 });
  });

  it("leaves keys of the browser alone", () => {
    const { connection } = setUp();
    document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "s", code: "KeyS", ctrlKey: true, bubbles: true }));
    expect(connection.driven).toEqual([]);
  });

  it("stays within the limits when several keys are held", () => {
    const { drive } = setUp();
    drive.hold("disc", 0.8, 0);
    drive.hold("pad 0", 0.9, -3);
    expect(drive.command.value).toEqual({ linear: 0.5, angular: -1 });
  });

  it("offers topics with subscribers, the session's first, and none without", () => {
    const { drive, connection } = fakePage({ drive_topic: "/robot/cmd_vel" });
    expect([drive.topics.value, drive.topic.value]).toEqual([[], null]);
    connection.advertise("/told", "geometry_msgs/TwistStamped");
    connection.listen("/told", "geometry_msgs/TwistStamped", "/trundle_page_1");
    connection.listen("/told", "geometry_msgs/TwistStamped", "/rviz");
    connection.listen("/scan", "sensor_msgs/LaserScan");
    expect(drive.topic.value).toBeNull();
    connection.listen("/a/move", "geometry_msgs/TwistStamped");
    connection.listen("/robot/cmd_vel", "geometry_msgs/Twist");
    expect([drive.topics.value, drive.topic.value]).toEqual([["/robot/cmd_vel", "/a/move"], "/robot/cmd_vel"]);
  });

  it("drives only one topic, which can be chosen", () => {
    const { drive, connection } = setUp();
    connection.listen("/turtle1/cmd_vel", "geometry_msgs/Twist");
    drive.hold("disc", 1, 0);
    drive.choose("/turtle1/cmd_vel");
    expect(connection.released).toBe(1);
    drive.hold("disc", 1, 0);
    expect(connection.driven.at(-1)?.topic).toBe("/turtle1/cmd_vel");
  });
});
