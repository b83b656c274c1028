import { fileURLToPath } from "node:url";
import { defineConfig } from "vitest/config";

import { compressed } from "./compressed.ts";
import { licenses } from "./licenses.ts";
import { preloads } from "./preloads.ts";

const { page, worker } = licenses();

export default defineConfig({
  base: "./",
  plugins: [page, preloads(), compressed()],
  build: {
    outDir: fileURLToPath(new URL("../src/trundle/page/client", import.meta.url)),
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0, // the content security policy has no data: for scripts
    cssCodeSplit: false, // one style sheet, in the document: what comes later is never seen without it
    chunkSizeWarningLimit: 2500, // it comes from this machine or the same network
    rolldownOptions: { checks: { bundlerTimings: false } }, // figures of a busy machine are no fault of the code
  },
  worker: { format: "es", plugins: () => [worker] },
  // Tests leave nothing behind; a process for each file would double their time.
  test: {
    isolate: false,
    include: ["test/**/*.test.ts", "test/**/*.test.tsx"],
    testTimeout: 120_000, // a slow machine is no failure
    hookTimeout: 120_000,
  },
});
