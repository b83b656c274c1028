import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

import { expect, test } from "vitest";
import { build, type Plugin, type Rolldown } from "vite";

import { licenses, packageFolder } from "../../licenses.ts";
import { isLibrary } from "../../preloads.ts";

const WEB = fileURLToPath(new URL("../..", import.meta.url));
const SLOW = 60_000;

/** Names of the packages of some files, from the paths of their modules. */
function packageNames(modules: Iterable<string>): Set<string> {
  const folders = [...modules].map(packageFolder).filter((folder) => folder !== null);
  return new Set(folders.map((folder) => folder.slice(folder.lastIndexOf("node_modules/") + "node_modules/".length)));
}

/** Headings of the file of licences, without versions and our own. */
function headings(output: readonly (Rolldown.OutputChunk | Rolldown.OutputAsset)[]): Set<string> {
  const file = output.find((one) => one.fileName === "licenses.txt");
  const text = file?.type === "asset" ? String(file.source) : "";
  const names = text.split(/^={100}\n/m).map((section) => section.split("\n", 1)[0]?.replace(/ [\d.]+$/, "") ?? "");
  expect(names[0]).toBe("Trundle");
  return new Set(names.slice(1));
}

async function bundle(options: Parameters<typeof build>[0]): Promise<Rolldown.RolldownOutput["output"]> {
  const result = await build({ root: WEB, logLevel: "silent", ...options, build: { ...options?.build, write: false } });
  if (Array.isArray(result) || !("output" in result)) throw new Error("there is one bundle");
  return result.output;
}

test(
  "every package in the page's bundle has its licence in licenses.txt, and so has its one font, which is small",
  async () => {
    const modules = new Set<string>();
    const collect: Plugin = {
      name: "collect",
      generateBundle(_options, files) {
        for (const file of Object.values(files)) {
          if (file.type === "chunk") for (const module of file.moduleIds) modules.add(module);
        }
      },
    };
    const output = await bundle({ configFile: `${WEB}/vite.config.ts`, plugins: [collect] });

    const packages = packageNames(modules);
    const licensed = headings(output);
    expect(packages).toContain("preact");
    expect([...packages, "Inter"].filter((name) => !licensed.has(name))).toEqual([]);
    const fonts = output.filter(({ fileName }) => fileName.endsWith(".woff2"));
    expect(fonts.map((font) => (font.type === "asset" ? font.source.length : Infinity) < 60_000)).toEqual([true]);
    expectFewFirst(output);
  },
  SLOW,
);

/** The document's script is small and names all others; what the first picture needs is without the dock and its panels. */
function expectFewFirst(output: Rolldown.RolldownOutput["output"]): void {
  const chunks = output.filter((file) => file.type === "chunk");
  const entry = chunks.find(({ isEntry }) => isEntry);
  const page = chunks.find(({ fileName }) => entry?.dynamicImports.includes(fileName));
  expect(entry?.code.length).toBeLessThan(10_000);
  const file = output.find(({ fileName }) => fileName === "index.html");
  const document = file?.type === "asset" ? String(file.source) : "";
  expect(chunks.filter((chunk) => !isLibrary(chunk) && !document.includes(chunk.fileName))).toEqual([]);
  const first = packageNames(
    [page, ...chunks.filter(({ fileName }) => page?.imports.includes(fileName))].flatMap(
      (chunk) => chunk?.moduleIds ?? [],
    ),
  );
  expect(first).toContain("three");
  for (const name of ["dockview-core", "uplot", "@dagrejs/dagre", "hyparquet-writer"])
    expect(first).not.toContain(name);
}

test(
  "a worker's packages have theirs, and those that they carry",
  async () => {
    const { page, worker } = licenses();
    const output = await bundle({
      configFile: false,
      plugins: [page],
      worker: { format: "es", plugins: () => [worker] },
      build: { rolldownOptions: { input: fileURLToPath(new URL("only_a_worker.ts", import.meta.url)) } },
    });

    expect(headings(output)).toEqual(
      new Set(["@foxglove/rosmsg", "nearley, in @foxglove/rosmsg", "moo, in @foxglove/rosmsg"]),
    );
  },
  SLOW,
);

test("the lock file names no registry, so that any mirror works", () => {
  expect(readFileSync(`${WEB}/package-lock.json`, "utf8")).not.toMatch(/https?:\/\/[^"]*\.tgz|"resolved"/);
});
