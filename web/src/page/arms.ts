/** Nodes that plan arms: MoveIt's move_group. */

import type { Connection } from "../protocol/connection";

const RESULT = "moveit_msgs/MoveGroupActionResult";
const END = "/move_group/result";

/** Namespaces in which a move_group runs, as "" or "/left"; empty: there is none. */
export function moveGroupNamespaces({ topics }: Pick<Connection, "topics">): readonly string[] {
  return [...topics.value.values()]
    .filter(({ name, type }) => type === RESULT && name.endsWith(END))
    .map(({ name }) => name.slice(0, -END.length))
    .sort();
}
