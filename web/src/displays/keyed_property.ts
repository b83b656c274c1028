/** Heading with rows that appear at run time: links of a robot, frames, namespaces of markers. */

import { GroupProperty, isMapping, type Property, type Yaml, type YamlMapping } from "../rviz/properties";

/** Keeps the file's values of rows that have not appeared yet, and applies them when they do. */
export class KeyedProperty<P extends Property<unknown>> extends GroupProperty {
  private stored: YamlMapping = {};
  private readonly rows = new Map<string, P>();

  /** The row of a name; made by `make` the first time. */
  row(name: string, make: () => P): P {
    const existing = this.rows.get(name);
    if (existing !== undefined) return existing;
    const property = make();
    this.rows.set(name, property);
    const saved = this.stored[name];
    if (saved !== undefined) property.load(saved);
    this.add(property);
    return property;
  }

  get(name: string): P | undefined {
    return this.rows.get(name);
  }

  entries(): IterableIterator<[string, P]> {
    return this.rows.entries();
  }

  forget(name: string): void {
    const row = this.rows.get(name);
    if (row === undefined) return;
    this.rows.delete(name);
    this.remove(row);
  }

  /** Save rows that the file had or that differ from their defaults, so that a new robot does not change the file. */
  override save(): Yaml {
    const saved: Record<string, Yaml> = { ...this.stored };
    if (this.version.value === 0) return saved;
    for (const child of this.children) {
      const yaml = child.save();
      if (yaml !== undefined && (child.name in this.stored || isEdited(child))) saved[child.name] = yaml;
    }
    return saved;
  }

  override load(yaml: Yaml): string[] {
    this.stored = isMapping(yaml) ? yaml : {};
    return this.children.flatMap((child) => {
      const saved = this.stored[child.name];
      return saved === undefined ? [] : child.load(saved);
    });
  }
}

function isEdited({ value, initial, options, children }: Property<unknown>): boolean {
  return (options.readOnly !== true && value.value !== initial) || children.some(isEdited);
}
