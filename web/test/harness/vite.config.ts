import { readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

const root = fileURLToPath(new URL(".", import.meta.url));

/** Pages on which a room is looked at alone: `vite build --config test/harness/vite.config.ts --outDir …`. */
export default defineConfig({
  root,
  base: "./",
  build: {
    target: "es2022",
    minify: false,
    rolldownOptions: {
      input: readdirSync(root)
        .filter((name) => name.endsWith(".html"))
        .map((name) => root + name),
    },
  },
});
