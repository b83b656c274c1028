/** Viewer of replays: one script and one style sheet, which each replay's HTML contains. */

import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

import { licenses } from "./licenses.ts";

export default defineConfig({
  plugins: [licenses().page],
  publicDir: false,
  build: {
    outDir: fileURLToPath(new URL("../src/trundle/page/client/replay", import.meta.url)),
    target: "es2022",
    assetsInlineLimit: 1e6,
    emptyOutDir: true,
    cssCodeSplit: false,
    chunkSizeWarningLimit: 2500,
    rolldownOptions: {
      input: fileURLToPath(new URL("src/replay/main.tsx", import.meta.url)),
      output: { format: "iife", entryFileNames: "replay.js", assetFileNames: "replay[extname]" },
      checks: { bundlerTimings: false },
    },
  },
});
