/** Adds a gzip file beside each larger text file, for browsers that accept it: `index.js.gz`. */

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import type { Plugin } from "vite";

const TEXT = /\.(js|css|html)$/;
/** Below this a file travels in one packet. */
const MIN_BYTES = 1400;

export function compressed(): Plugin {
  return {
    name: "compressed",
    writeBundle({ dir = "." }, files) {
      for (const name of Object.keys(files)) {
        const content = TEXT.test(name) ? readFileSync(join(dir, name)) : Buffer.of();
        if (content.length > MIN_BYTES) writeFileSync(join(dir, `${name}.gz`), gzipSync(content, { level: 9 }));
      }
    },
  };
}
