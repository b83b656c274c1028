/** Adds preload links for the font and the scripts that the document's script imports later, so that they load in parallel. */

import type { HtmlTagDescriptor, Plugin, Rolldown } from "vite";

export function preloads(): Plugin {
  return {
    name: "preloads",
    transformIndexHtml: {
      order: "post",
      handler(_html, { bundle, chunk }) {
        if (bundle === undefined || chunk === undefined) return [];
        const fonts = Object.keys(bundle).filter((name) => name.endsWith(".woff2"));
        return [
          ...fonts.map((name) => link(name, { rel: "preload", as: "font", type: "font/woff2" })),
          ...[...laterScripts(bundle, chunk)].map((name) => link(name, { rel: "modulepreload" })),
        ];
      },
    },
  };
}

function link(name: string, attrs: Readonly<Record<string, string>>): HtmlTagDescriptor {
  return { tag: "link", injectTo: "head", attrs: { ...attrs, crossorigin: true, href: `./${name}` } };
}

/** True for a library that is imported by itself, since few pages use it. */
export function isLibrary({ facadeModuleId }: Rolldown.OutputChunk): boolean {
  return facadeModuleId?.includes("/node_modules/") ?? false;
}

/** Scripts that a chunk imports while it runs, and those that these import, in the order in which they are needed. */
function laterScripts(bundle: Rolldown.OutputBundle, first: Rolldown.OutputChunk): Set<string> {
  const chunkOf = (name: string): Rolldown.OutputChunk | null => {
    const file = bundle[name];
    return file?.type === "chunk" ? file : null;
  };
  const known = new Set<string>();
  const add = (chunk: Rolldown.OutputChunk): void => {
    for (const name of [
      ...chunk.dynamicImports.flatMap((later) => [later, ...(chunkOf(later)?.imports ?? [])]),
      ...chunk.imports,
    ]) {
      const next = chunkOf(name);
      if (known.has(name) || next === null || isLibrary(next)) continue;
      known.add(name);
      add(next);
    }
  };
  add(first);
  for (const name of [first.fileName, ...first.imports]) known.delete(name);
  return known;
}
