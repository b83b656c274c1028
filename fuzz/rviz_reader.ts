/** Reads .rviz files from standard input, each after its length; answers a line each: nothing, or an unexpected error. */

import { readSync, writeSync } from "node:fs";

import { RvizFile, RvizFileError } from "../web/src/rviz/rviz_file";

function receive(size: number): Buffer {
  const buffer = Buffer.alloc(size);
  for (let start = 0; start < size; ) {
    const count = readSync(0, buffer, start, size - start, null);
    if (count === 0) process.exit(0);
    start += count;
  }
  return buffer;
}

function read(text: string): string {
  try {
    const file = RvizFile.parse(text);
    RvizFile.parse(file.write(file.content()));
    return "";
  } catch (error) {
    return error instanceof RvizFileError ? "" : String((error as Error).stack);
  }
}

for (;;) {
  const text = receive(receive(4).readUInt32LE()).toString("utf8");
  writeSync(1, JSON.stringify(read(text)) + "\n");
}
