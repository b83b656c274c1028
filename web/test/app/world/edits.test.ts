// @vitest-environment jsdom
import { Quaternion, Vector3 } from "three";
import { expect, it, vi } from "vitest";

import { Notices } from "../../../src/app/notices/notices";
import type { Shell } from "../../../src/app/shell";
import { rollPitchYaw } from "../../../src/app/inspector/twist";
import { editWorld } from "../../../src/app/world/edits";
import type { Fields, RequestName } from "../../../src/protocol/connection";
import { fakePage } from "../../fake_page";
import { orientationOf, poseFields, withNumber } from "../../../src/page/request_fields";

const BASE = { model: "cart", link: "base" };

function fakeShell(answer: () => Promise<unknown>): { shell: Shell; sent: object[] } {
  const page = fakePage();
  const sent: object[] = [];
  const request = vi.spyOn(page.connection, "request").mockImplementation((name, fields) => {
    sent.push({ name, ...fields });
    return answer() as ReturnType<typeof page.connection.request>;
  });
  expect(request).toBeDefined();
  const notices = new Notices(page);
  const shell = {
    page,
    notices,
    request: <N extends RequestName>(_: string, name: N, fields: Fields<N>) =>
      void page.connection.request(name, fields),
  };
  return { shell: shell as unknown as Shell, sent };
}

it("can be undone only after the server has done it", async () => {
  const { shell, sent } = fakeShell(() => Promise.resolve({}));
  const edit = editWorld(shell, "Mass of base", "mass", { ...BASE, mass: 4 }, { ...BASE, mass: 2 });
  expect(shell.page.undo.undoTitle.value).toBeNull();
  await edit;
  expect(shell.page.undo.undoTitle.value).toBe("Mass of base");
  shell.page.undo.undo();
  shell.page.undo.redo();
  expect(sent).toEqual([4, 2, 4].map((mass) => ({ name: "mass", ...BASE, mass })));
});

it("a refused edit cannot be undone, and is reported with its reason", async () => {
  const { shell } = fakeShell(() => Promise.reject(new Error("link 'arm' has no collision, and so no friction")));
  await editWorld(shell, "Friction of arm", "friction", { ...BASE, mu: 4, mu2: 1 }, { ...BASE, mu: 2, mu2: 1 });
  expect(shell.page.undo.undoTitle.value).toBeNull();
  expect(shell.notices.line.value.text).toContain("no collision");
});

it("sends poses in the server's format", () => {
  expect(poseFields(new Vector3(1, 2, 3), new Quaternion(0, 0, 1, 0))).toEqual({
    position: [1, 2, 3],
    orientation: [0, 0, 0, 1],
  });
  const angles = [0.3, -0.4, 2] as const;
  rollPitchYaw(orientationOf(angles)).forEach((angle, index) => expect(angle).toBeCloseTo(angles[index] ?? 0));
  expect(withNumber([1, 2, 3], 1, 7)).toEqual([1, 7, 3]);
});
