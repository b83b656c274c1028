/** rviz's Visibility of a camera: displays drawn over its picture; groups have rows of their members. */

import type { Object3D } from "three";

import type { Display } from "../display";
import { BoolProperty, isMapping, type Yaml, type YamlMapping } from "../../rviz/properties";

/** Members of a display that is a group. */
interface Members {
  readonly displays: readonly Display[];
}

function membersOf(display: Display): readonly Display[] {
  return "displays" in display ? (display as unknown as Members).displays : [];
}

export class VisibilityProperty extends BoolProperty {
  private stored: YamlMapping = {};
  private readonly rows = new Map<string, VisibilityProperty>();

  constructor(name = "Visibility") {
    super(name, true);
  }

  /** Keep a row for each display, by name; a saved value is applied when the display appears. */
  follow(displays: readonly Display[]): void {
    const named = new Map(displays.map((display) => [display.name.value, display]));
    for (const [name, row] of this.rows) {
      if (named.has(name)) continue;
      this.rows.delete(name);
      this.remove(row);
    }
    for (const [name, display] of named) (this.rows.get(name) ?? this.makeRow(name)).follow(membersOf(display));
  }

  /** Objects of displays that this camera hides. */
  hidden(displays: readonly Display[], isShown = this.value.peek()): readonly Object3D[] {
    return displays.flatMap((display) => {
      const row = this.rows.get(display.name.peek());
      const isVisible = isShown && (row?.value.peek() ?? true);
      const below = row?.hidden(membersOf(display), isVisible) ?? [];
      return isVisible ? below : [display.root, ...below];
    });
  }

  /** Save only rows that the file had or that are off, so that new displays do not change the file. */
  override save(): Yaml {
    const saved: Record<string, Yaml> = { ...this.stored };
    const rows = this.version.value === 0 ? [] : this.rows;
    for (const [name, row] of rows) if (name in this.stored || row.isEdited) saved[name] = row.save();
    saved["Value"] = this.value.value;
    return Object.keys(saved).length === 1 && this.rows.size === 0 ? this.value.value : saved;
  }

  override load(yaml: Yaml): string[] {
    this.stored = isMapping(yaml) ? yaml : {};
    const value = isMapping(yaml) ? (yaml["Value"] ?? true) : yaml;
    const faults = this.decode(value) ? [] : [`${this.name}: ${JSON.stringify(value)} is no ${this.kind}`];
    for (const [name, row] of this.rows) faults.push(...row.load(this.stored[name] ?? true));
    return faults;
  }

  private get isEdited(): boolean {
    return !this.value.value || [...this.rows.values()].some((row) => row.isEdited);
  }

  private makeRow(name: string): VisibilityProperty {
    const row = new VisibilityProperty(name);
    const saved = this.stored[name];
    if (saved !== undefined) row.load(saved);
    this.rows.set(name, row);
    return this.add(row);
  }
}
