import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

import { DriveService, LEASE, type DriveReport } from "../../src/protocol/drive_service";
import { FakeSocket } from "./fake_server";

const FORWARD = { topic: "/cmd_vel", linear: 0.5, angular: 0 };

describe("the worker that drives", () => {
  let socket: FakeSocket;
  let service: DriveService;
  let reports: DriveReport[];
  const open = (): void => {
    socket.onopen?.call(null as never, new Event("open"));
  };
  const drive = (command = FORWARD): void => service.handle({ kind: "drive", command });
  const answer = (): void => {
    for (const command of socket.ops("trundle/drive"))
      socket.text({ op: "trundle/driven", number: command["number"] as number });
  };
  /** Time passes on a link that answers, with a page that renews its request or does not. */
  const pass = (time: number, renews: boolean): void => {
    for (let passed = 0; passed < time; passed += 50) {
      vi.advanceTimersByTime(50);
      answer();
      if (renews) drive();
    }
  };

  beforeEach(() => {
    vi.useFakeTimers();
    reports = [];
    service = new DriveService(
      () => {
        socket = new FakeSocket();
        return socket;
      },
      (report) => void reports.push(report),
    );
    open();
  });
  afterEach(() => {
    service.handle({ kind: "release" });
    vi.useRealTimers();
  });

  it("drives at 10 Hz while the page is silent, for the rest of its lease, then stops", () => {
    drive();
    pass(500, false);
    const leases = socket.ops("trundle/drive").map((command) => command["lease"]);
    expect(leases).toEqual([1, 0.9, 0.8, 0.7, 0.6, 0.5]);
    expect(socket.ops("trundle/release")).toEqual([]);
    pass(LEASE, false);
    expect(socket.ops("trundle/drive").length).toBe(10);
    expect(socket.ops("trundle/release")).toEqual([{ op: "trundle/release", topic: "/cmd_vel" }]);
    expect(reports).toEqual([]);
  });

  it("sends a new command and the release at once", () => {
    drive();
    drive({ ...FORWARD, angular: 1 });
    service.handle({ kind: "release" });
    service.handle({ kind: "release" });
    expect(socket.sent).toMatchObject([FORWARD, { angular: 1 }, { op: "trundle/release" }]);
  });

  it("says how late commands are while the server does not answer, and sends few of them", () => {
    drive();
    for (let i = 0; i < 20; i++) {
      vi.advanceTimersByTime(100);
      drive();
    }
    expect(socket.ops("trundle/drive").length).toBe(4);
    expect(reports.at(-1)).toEqual({ kind: "delay", delay: 2 });
    answer();
    expect(reports.at(-1)).toEqual({ kind: "delay", delay: 1.7 }); // of the newest receipt
    pass(200, true);
    expect(reports.at(-1)).toEqual({ kind: "delay", delay: 0 });
  });

  it("goes on after a lost connection, while the page renews its request", () => {
    drive();
    socket.close();
    pass(950, true);
    expect(reports.at(-1)).toMatchObject({ kind: "delay", delay: expect.closeTo(0.9, 0) as number });
    pass(100, true);
    open();
    expect(socket.sent).toEqual([]);
    pass(100, true);
    expect(socket.sent).toMatchObject([FORWARD]);
    expect(reports.at(-1)).toEqual({ kind: "delay", delay: 0 });
  });

  it("passes on why the server refuses", () => {
    drive();
    socket.text({ op: "status", level: 2, message: "/chatter cannot be driven" });
    expect(reports).toEqual([{ kind: "fault", text: "/chatter cannot be driven" }]);
  });
});
