/** Reasons why entries of an .rviz file cannot be shown. */

const PACKAGES: Readonly<Record<string, string>> = {
  moveit_rviz_plugin: "MoveIt",
  object_recognition_ros: "object_recognition_ros",
  jsk_rviz_plugins: "jsk_rviz_plugins",
};

export function unsupportedReason(className: string): string {
  const [packageName = "", short = ""] = className.split("/");
  if (className === "") return "the entry names no class";
  if (["rviz", "rviz_default_plugins", "rviz_common"].includes(packageName)) return `rviz has no display ${short}`;
  return `a plugin of ${PACKAGES[packageName] ?? packageName}; only rviz's own displays are shown here`;
}
