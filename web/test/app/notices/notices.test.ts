// @vitest-environment jsdom
import { expect, it } from "vitest";

import { Notices } from "../../../src/app/notices/notices";
import { fakePage } from "../../fake_page";

it("is one line with counts, and a list with the most severe first", () => {
  const page = fakePage();
  const { displays, connection } = page;
  const notices = new Notices(page);
  expect(notices.line.value.text).toBe("");
  displays.show("rviz/Map", null, null).status("warn", "No map received");
  displays.show("rviz/LaserScan", null, null).status("warn", "No messages received");
  displays.show("rviz/PoseArray", null, null).status("error", "No transform from [amcl] to [map]");
  const off = displays.show("rviz/Path", null, null).status("error", "Transform");
  off.enabled.value.value = false;
  connection.notices.value = [{ level: "warning", text: "38 meshes are missing" }];
  expect(notices.line.value).toEqual({
    level: "warn",
    text: "2 displays have no data · 1 has no transform · 38 meshes are missing",
  });
  expect(notices.all.value.map(({ level, title }) => `${level} ${title}`)).toEqual([
    "error PoseArray",
    "warn Server",
    "warn Map",
    "warn LaserScan",
  ]);
  notices.dismiss();
  expect(notices.line.value.text).toBe("");
  notices.report("Play", "The simulator has stopped.");
  expect(notices.line.value).toMatchObject({
    level: "error",
    text: expect.stringContaining("Play: The simulator has stopped.") as string,
  });
});

it("counts missing meshes, not the displays that use them", () => {
  const page = fakePage();
  const notices = new Notices(page);
  for (const name of ["rviz/RobotModel", "rviz/Marker"])
    page.displays.show(name, null, null).status("error", "Could not load mesh resource 'package://a/b.dae'");
  expect(notices.line.value.text).toBe("2 meshes are missing");
});

it("counts warnings about files, and lists equal ones once with their lines", () => {
  const page = fakePage();
  const notices = new Notices(page);
  const warning = (line: number): { level: "warning"; text: string; id: string } => ({
    level: "warning",
    text: `cart.sdf:${line}: mass must be > 0 kg`,
    id: `file/${line}`,
  });
  page.connection.notices.value = [warning(3)];
  expect(notices.line.value).toEqual({ level: "warn", text: "cart.sdf:3: mass must be > 0 kg" });
  page.connection.notices.value = [warning(3), warning(7), { level: "warning", text: "38 meshes are missing" }];
  expect(notices.line.value.text).toBe("38 meshes are missing · 2 warnings about the files");
  expect(notices.all.value).toEqual([
    { level: "warn", title: "Server", text: "38 meshes are missing" },
    { level: "warn", title: "File", text: "cart.sdf:3: mass must be > 0 kg", advice: "2 times: also at cart.sdf:7" },
  ]);
});
