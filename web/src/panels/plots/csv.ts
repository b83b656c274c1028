/** Curves as comma-separated values. */

export interface CsvColumn {
  readonly name: string;
  readonly xs: ArrayLike<number>;
  readonly ys: ArrayLike<number>;
}

/** Text with a row per time at which any curve has a point; cells of curves without a point at that time stay empty. */
export function csvText(columns: readonly CsvColumn[]): string {
  const rows = new Map<number, (number | undefined)[][]>();
  columns.forEach((column, at) => {
    for (let index = 0; index < column.xs.length; index += 1) {
      const time = column.xs[index] ?? 0;
      const same = rows.get(time) ?? [];
      const row = same.find((one) => one[at] === undefined) ?? [];
      row[at] = column.ys[index];
      if (!same.includes(row)) same.push(row);
      rows.set(time, same);
    }
  });
  const lines = [["time", ...columns.map((column) => quoted(column.name))].join(",")];
  for (const [time, same] of [...rows].sort(([one], [other]) => one - other)) {
    const text = time.toFixed(9).replace(/\.?0+$/, "");
    for (const row of same) lines.push([text, ...columns.map((_, at) => row[at] ?? "")].join(","));
  }
  return `${lines.join("\n")}\n`;
}

function quoted(name: string): string {
  return /[",\n]/.test(name) ? `"${name.replace(/"/g, '""')}"` : name;
}
