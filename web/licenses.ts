/** Licences of the packages in the bundle, in one file beside it. */

import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "vite";

const FILE = "licenses.txt";
const OWN = readFileSync(new URL("../LICENSE", import.meta.url), "utf8");
/** License of the page's font. */
const FONT_LICENSE = new URL("src/theme/fonts/inter.txt", import.meta.url);
const RULE = `\n${"=".repeat(100)}\n`;

/** Packages bundled inside others without their licence. */
const CARRIED: Readonly<Record<string, readonly string[]>> = { "@foxglove/rosmsg": ["nearley", "moo"] };

interface PackageJson {
  readonly name: string;
  readonly version: string;
  readonly license: string;
  readonly author?: string | { readonly name: string };
}

/** Folder of the package that a module belongs to; null: it is our own. */
export function packageFolder(module: string): string | null {
  return /^.*\/node_modules\/(?:@[^/]+\/)?[^/]+/.exec(module)?.[0] ?? null;
}

/** Plugins for the page and for its workers; the page's writes the file, with the packages of both. */
export function licenses(): { readonly page: Plugin; readonly worker: Plugin } {
  const folders = new Set<string>();
  const collect = (modules: Iterable<string>): void => {
    for (const module of modules) {
      const folder = packageFolder(module);
      if (folder !== null) folders.add(folder);
    }
  };
  return {
    page: {
      name: "licenses",
      generateBundle(_options, bundle) {
        collect(this.getModuleIds());
        const hasFont = Object.keys(bundle).some((name) => name.endsWith(".woff2"));
        const font = hasFont ? [`Inter\n\n${readFileSync(FONT_LICENSE, "utf8")}`] : [];
        const sections = [`Trundle\n\n${OWN}`, ...font, ...[...folders].sort().flatMap(sectionsOf)];
        this.emitFile({ type: "asset", fileName: FILE, source: sections.join(RULE) });
      },
    },
    worker: {
      name: "licenses-of-workers",
      generateBundle() {
        collect(this.getModuleIds());
      },
    },
  };
}

function sectionsOf(folder: string): string[] {
  const about = JSON.parse(readFileSync(join(folder, "package.json"), "utf8")) as PackageJson;
  const file = readdirSync(folder).find((name) => /^licen[cs]e(\.|$)/i.test(name));
  const text = file === undefined ? withoutFile(about) : readFileSync(join(folder, file), "utf8");
  const carried = (CARRIED[about.name] ?? []).map(
    (name) => `${name}, in ${about.name}\n\n${readFileSync(new URL(`licenses/${name}.txt`, import.meta.url), "utf8")}`,
  );
  return [`${about.name} ${about.version}\n\n${text}`, ...carried];
}

/** Text for a package without a licence file: Apache-2.0 only, whose text is Trundle's own. */
function withoutFile({ name, license, author }: PackageJson): string {
  if (license !== "Apache-2.0") throw new Error(`${name} has the licence ${license}, but no file with its text`);
  const holder = typeof author === "string" ? author : (author?.name ?? "its authors");
  return `Copyright ${holder}\nApache License, Version 2.0, whose text is above\n`;
}
