/** Icons of the parts of a model. */

import type { DraftPart } from "../../protocol/generated/page_messages";
import type { IconName } from "../../theme/icons";

const ICONS: Readonly<Record<string, IconName>> = {
  model: "model",
  link: "link",
  joint: "joint",
  plugin: "plugin",
  visual: "eye",
  collision: "box",
  sensor: "sensor",
};

export function iconOf({ tag, detail }: Pick<DraftPart, "tag" | "detail">): IconName {
  return tag === "sensor" && /camera|depth/.test(detail) ? "camera" : (ICONS[tag] ?? "frame");
}
