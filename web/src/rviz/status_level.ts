/** Levels of rviz's statuses; "none": there is no data. */

export type StatusLevel = "ok" | "warn" | "error" | "none";
