import { expect, it } from "vitest";

import { moveGroupNamespaces } from "../../src/page/arms";
import { FakeConnection } from "../fake_connection";

it("finds move_group by its action, in every namespace", () => {
  const connection = new FakeConnection();
  expect(moveGroupNamespaces(connection)).toEqual([]);
  connection.advertise("/right/move_group/result", "moveit_msgs/MoveGroupActionResult");
  connection.advertise("/move_group/result", "moveit_msgs/MoveGroupActionResult");
  connection.advertise("/left/move_group/result", "std_msgs/String");
  expect(moveGroupNamespaces(connection)).toEqual(["", "/right"]);
});
