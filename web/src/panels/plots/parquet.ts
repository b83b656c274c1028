/** Curves as a Parquet file: a row per point, with the curve's name. */

import { parquetWriteBuffer } from "hyparquet-writer";

import type { CsvColumn } from "./csv";

/** Columns `curve`, `time` [s] and `value`: each curve has times of its own. */
export function parquetFile(curves: readonly CsvColumn[]): ArrayBuffer {
  const names = curves.flatMap(({ name, xs }) => Array.from({ length: xs.length }, () => name));
  return parquetWriteBuffer({
    columnData: [
      { name: "curve", data: names, type: "STRING" },
      { name: "time", data: joined(curves.map(({ xs }) => xs)), type: "DOUBLE" },
      { name: "value", data: joined(curves.map(({ ys }) => ys)), type: "DOUBLE" },
    ],
  });
}

function joined(parts: readonly ArrayLike<number>[]): Float64Array {
  const all = new Float64Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}
