/** Reasons why entries of an .rviz file cannot be shown. */

export function unsupportedReason(className: string): string {
  const [packageName = "", short = ""] = className.split("/");
  if (className === "") return "the entry names no class";
  if (["rviz", "rviz_default_plugins", "rviz_common"].includes(packageName)) return `rviz has no display ${short}`;
  return `a plugin of ${packageName}; only rviz's and MoveIt's displays and octomap's OccupancyGrid are shown here`;
}
