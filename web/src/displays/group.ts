/** Group: displays below one checkbox; the list of all displays is one, too. */

import { signal, type ReadonlySignal } from "@preact/signals";

import { Display, type DisplayContext } from "./display";
import type { Unsupported } from "./display_list";
import { isMapping, type Yaml, type YamlMapping } from "../rviz/properties";
import { displayClass, register } from "./registry";
import { unsupportedReason } from "./unsupported";

/** Entry of the file that cannot be shown, with its YAML. */
export interface UnsupportedEntry extends Unsupported {
  readonly yaml: Yaml;
}

export type Entry = Display | UnsupportedEntry;

export function isDisplay(entry: Entry): entry is Display {
  return entry instanceof Display;
}

/** Displays with their members, groups first; without those that `keep` refuses and their members. */
export function withMembers(
  displays: readonly Display[],
  keep: (display: Display) => boolean = () => true,
): readonly Display[] {
  return displays
    .filter(keep)
    .flatMap((display) => (display instanceof Group ? [display, ...withMembers(display.displays, keep)] : [display]));
}

export function isEnabled(display: Display): boolean {
  return display.enabled.value.value;
}

export class Group extends Display {
  readonly className = "rviz/Group";
  private readonly list = signal<readonly Entry[]>([]);
  private isActive = false;
  private readonly active = new Map<Display, () => void>();

  /** Displays and unsupported entries, in the file's order. */
  get entries(): ReadonlySignal<readonly Entry[]> {
    return this.list;
  }

  get displays(): readonly Display[] {
    return this.list.value.filter(isDisplay);
  }

  /** All displays below, groups before their members. */
  get all(): readonly Display[] {
    return withMembers(this.displays);
  }

  insert(entry: Entry, index = this.list.peek().length): void {
    this.list.value = this.list.peek().toSpliced(index, 0, entry);
    if (this.isActive && isDisplay(entry)) this.watch(entry);
  }

  remove(entry: Entry): void {
    this.list.value = this.list.peek().filter((other) => other !== entry);
    if (isDisplay(entry)) this.release(entry);
  }

  clear(): void {
    for (const entry of this.list.peek()) this.remove(entry);
  }

  protected onStart(): void {
    this.isActive = true;
    for (const display of this.list.peek().filter(isDisplay)) this.watch(display);
  }

  protected onStop(): void {
    this.isActive = false;
    for (const display of [...this.active.keys()]) this.release(display);
  }

  override update(now: bigint, elapsed: number): void {
    for (const display of this.active.keys())
      if (display.enabled.value.peek()) guard(display, () => display.update(now, elapsed));
  }

  override save(): YamlMapping {
    const { Value: value, ...saved } = super.save();
    const displays = this.list.value.map((entry) => (isDisplay(entry) ? entry.save() : entry.yaml));
    return { ...saved, Displays: displays, Value: value ?? true };
  }

  override load(yaml: YamlMapping): string[] {
    const { Displays: displays, ...rest } = yaml;
    const faults = super.load(rest);
    this.clear();
    for (const entry of Array.isArray(displays) ? displays : []) faults.push(...this.loadEntry(entry as Yaml));
    return faults;
  }

  private loadEntry(yaml: Yaml): string[] {
    const mapping = isMapping(yaml) ? yaml : {};
    const [className, name] = [text(mapping["Class"]), text(mapping["Name"])];
    const entry = displayClass(className);
    if (entry === undefined) {
      this.insert({ className, name, reason: unsupportedReason(className), yaml });
      return [];
    }
    const display = entry.create(this.context);
    display.name.value = entry.className.split("/")[1] ?? "";
    const faults = display.load(mapping);
    this.insert(display);
    return faults.map((fault) => `${display.name.peek()}: ${fault}`);
  }

  /** Start and stop a display as its checkbox says. */
  private watch(display: Display): void {
    let running = false;
    const stop = display.enabled.value.subscribe((enabled) => {
      if (enabled === running) return;
      running = enabled;
      guard(display, () => (enabled ? display.start() : display.stop()));
    });
    this.active.set(display, () => {
      stop();
      if (running) display.stop();
    });
  }

  private release(display: Display): void {
    this.active.get(display)?.();
    this.active.delete(display);
  }
}

/** Call a function of a display; an error becomes the display's status, and the others go on. */
function guard(display: Display, act: () => void): void {
  try {
    act();
  } catch (error) {
    display.fail(error);
  }
}

function text(yaml: Yaml | undefined): string {
  return typeof yaml === "string" ? yaml : "";
}

register({
  className: "rviz/Group",
  aliases: ["rviz_common/Group"],
  types: [],
  create: (context: DisplayContext) => new Group(context),
});
