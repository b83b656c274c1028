/** Names of a node: relative ones stand in its namespace, and any may be remapped. */

export class GraphNames {
  private readonly remappings: ReadonlyMap<string, string>;

  /** `remappings`: global name to global name. */
  constructor(
    private readonly namespace = "/",
    remappings: Readonly<Record<string, string>> = {},
  ) {
    this.remappings = new Map(Object.entries(remappings));
  }

  /** Resolved name; empty for an empty name. */
  resolve(name: string): string {
    if (name === "") return "";
    const global = name.startsWith("/") ? name : join(this.namespace, name);
    return this.remappings.get(global) ?? global;
  }

  /** Candidate names of a parameter: its own, then in the namespaces above, as searchParam tries them. */
  search(name: string): readonly string[] {
    const names = [this.resolve(name)];
    if (name === "" || name.startsWith("/")) return names;
    for (
      let at = this.namespace.lastIndexOf("/");
      at >= 0;
      at = at === 0 ? -1 : this.namespace.lastIndexOf("/", at - 1)
    ) {
      names.push(join(this.namespace.slice(0, at), name));
    }
    return [...new Set(names)];
  }
}

function join(namespace: string, name: string): string {
  return `${namespace === "/" ? "" : namespace}/${name}`;
}
