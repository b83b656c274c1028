/** Faults of the page in one line with counts, and as a list. */

import { computed, signal, type ReadonlySignal } from "@preact/signals";

import type { Display } from "../../displays/display";
import type { StatusLevel } from "../../rviz/status_level";
import { isEnabled, withMembers } from "../../displays/group";
import { count } from "../../theme/format";
import type { Page } from "../../page/page";

export interface Notice {
  readonly level: StatusLevel;
  /** Source of the fault: a display's name, "Server". */
  readonly title: string;
  readonly text: string;
  readonly advice?: string;
  readonly display?: Display;
}

const MAX_REPORTS = 100;
/** Prefix of the ids of warnings about the world's, the robot's and the launch's files. */
const FILE = "file/";

export class Notices {
  private readonly reports = signal<readonly Notice[]>([]);
  private readonly dismissed = signal("");
  /** All faults, most severe first. */
  readonly all: ReadonlySignal<readonly Notice[]>;
  /** Summary of the faults: "17 displays have no data · 1 has no transform"; empty text: no fault. */
  readonly line: ReadonlySignal<{ readonly level: StatusLevel; readonly text: string }>;

  constructor({ displays, connection, world }: Pick<Page, "displays" | "connection" | "world">) {
    const faults = computed(() => withMembers(displays.displays.value, isEnabled).flatMap(displayFaults));
    const unsupported = computed(() =>
      displays.unsupported.value.map(
        ({ name, className, reason }): Notice => ({ level: "warn", title: name || className, text: reason }),
      ),
    );
    const isWritten = (id: string | undefined): boolean => id?.startsWith(FILE) ?? false;
    const warnings = computed(() => connection.notices.value.filter(({ level }) => level !== "info"));
    const server = computed(() =>
      warnings.value
        .filter(({ id }) => !isWritten(id))
        .map(({ level, text }): Notice => ({ level: level === "error" ? "error" : "warn", title: "Server", text })),
    );
    const files = computed(() =>
      warnings.value
        .filter(({ id }) => isWritten(id))
        .map(({ text }): Notice => ({ level: "warn", title: "File", text })),
    );
    const drawn = computed(() => world.faults.value.map((text): Notice => ({ level: "warn", title: "World", text })));
    this.all = computed(() =>
      bySeverity([
        ...this.reports.value,
        ...equalOnce(server.value),
        ...equalOnce(files.value),
        ...equalOnce(drawn.value),
        ...faults.value,
        ...unsupported.value,
      ]),
    );
    this.line = computed(() => {
      const line = summary(
        this.reports.value,
        [...server.value, ...drawn.value],
        faults.value,
        unsupported.value.length,
        files.value,
      );
      return line.text === this.dismissed.value ? { level: "ok", text: "" } : line;
    });
  }

  /** Report a failed action of the person. */
  report(title: string, text: string, level: StatusLevel = "error"): void {
    const notice: Notice = { level, title, text };
    this.reports.value = [...this.reports.peek().filter((other) => other.text !== text), notice].slice(-MAX_REPORTS);
  }

  /** Hide the line until its text changes. */
  dismiss(): void {
    this.dismissed.value = this.line.peek().text;
    this.reports.value = [];
  }
}

/** True if no data has come yet, which is not a fault. */
export function isSilence({ level, text }: Pick<Notice, "level" | "text">): boolean {
  return level === "none" || (level === "warn" && /^No \w+ received$/.test(text));
}

/** Place at the beginning of a warning: `cart.sdf:3: `. */
const PLACE = /^(\S+:\d+): /;
const MAX_PLACES = 8;

/** Merge notices that differ only in their places into one, with their number and the other places. */
function equalOnce(notices: readonly Notice[]): readonly Notice[] {
  const equal = new Map<string, Notice[]>();
  for (const notice of notices) {
    const key = `${notice.level} ${notice.text.replace(PLACE, "")}`;
    equal.set(key, [...(equal.get(key) ?? []), notice]);
  }
  return [...equal.values()].flatMap(([first, ...others]) => {
    if (first === undefined) return [];
    if (others.length === 0) return [first];
    const places = others.map(({ text }) => PLACE.exec(text)?.[1]).filter((place) => place !== undefined);
    const more = places.length > MAX_PLACES ? " …" : "";
    const where = places.length === 0 ? "" : `: also at ${places.slice(0, MAX_PLACES).join(", ")}${more}`;
    return [{ ...first, advice: `${others.length + 1} times${where}` }];
  });
}

const RANK: Readonly<Record<StatusLevel, number>> = { error: 0, warn: 1, none: 2, ok: 3 };

function bySeverity(notices: readonly Notice[]): readonly Notice[] {
  return [...notices].sort((a, b) => RANK[a.level] - RANK[b.level]);
}

function displayFaults(display: Display): Notice[] {
  return [...display.statuses.value]
    .filter(([, status]) => status.level !== "ok")
    .map(([, status]) => ({ ...status, title: display.name.value, display }));
}

function summary(
  reports: readonly Notice[],
  server: readonly Notice[],
  faults: readonly Notice[],
  unsupported: number,
  files: readonly Notice[],
): { level: StatusLevel; text: string } {
  const displays = (predicate: (notice: Notice) => boolean): number =>
    new Set(faults.filter(predicate).map((notice) => notice.display)).size;
  const isTransform = (notice: Notice): boolean => /no transform|fixed frame/i.test(notice.text);
  const isMesh = (notice: Notice): boolean => notice.text.startsWith("Could not load mesh");
  const isSilent = (notice: Notice): boolean => !isTransform(notice) && isSilence(notice);
  const silent = displays(isSilent);
  const lost = displays(isTransform);
  const meshes = faults.filter(isMesh).length;
  const other = displays((notice) => !isTransform(notice) && !isSilent(notice) && !isMesh(notice));
  const parts: string[] = reports.slice(-1).map(({ title, text }) => `${title}: ${text}`);
  const say = (number: number, one: string, many: string): void => {
    if (number > 0) parts.push(number === 1 ? one : `${number} ${many}`);
  };
  say(silent, "1 display has no data", "displays have no data");
  const noun = silent > 0 ? "" : "display ";
  say(lost, `1 ${noun}has no transform`, silent > 0 ? "have no transform" : "displays have no transform");
  say(meshes, "1 mesh is missing", "meshes are missing");
  say(other, "1 display has a fault", "displays have faults");
  say(unsupported, "1 display is not supported", "displays are not supported");
  if (server.length === 1) parts.push(server[0]?.text ?? "");
  else if (server.length > 1) parts.push(count(server.length, "warning"));
  say(files.length, files[0]?.text ?? "", "warnings about the files");
  const isDone = parts.length === 1 && reports.at(-1)?.level === "ok";
  const isFault = [...reports, ...server].some((notice) => notice.level === "error");
  return { level: isDone ? "ok" : isFault ? "error" : "warn", text: parts.join(" · ") };
}
