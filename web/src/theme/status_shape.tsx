/** Status by shape and color both: disc, triangle, square with a cross, ring. */

import type { JSX } from "preact";

import type { StatusLevel } from "../rviz/status_level";

const NAMES: Readonly<Record<StatusLevel, string>> = { ok: "OK", warn: "Warning", error: "Error", none: "No data" };

/** Shape of a status; an empty label if the text beside it says the same. */
export function StatusShape({
  level,
  label = NAMES[level],
}: {
  readonly level: StatusLevel;
  readonly label?: string;
}): JSX.Element {
  const accessibility =
    label === "" ? ({ "aria-hidden": true } as const) : ({ role: "img", "aria-label": label } as const);
  return (
    <svg class={`st ${level}`} viewBox="0 0 12 12" {...accessibility}>
      {level === "ok" && <circle cx="6" cy="6" r="4" fill="currentColor" />}
      {level === "none" && <circle cx="6" cy="6" r="3.6" fill="none" stroke="currentColor" stroke-width="1.6" />}
      {level === "warn" && <path d="M6 1.2L11.3 10.8H.7z" fill="currentColor" />}
      {level === "error" && <rect x="1" y="1" width="10" height="10" rx="2" fill="currentColor" />}
      {level === "error" && (
        <path d="M4 4l4 4M8 4l-4 4" stroke="var(--panel)" stroke-width="1.6" stroke-linecap="round" />
      )}
    </svg>
  );
}
