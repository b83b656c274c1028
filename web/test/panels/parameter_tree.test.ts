import { expect, test } from "vitest";

import { parameterFromText, parameterRows, parameterText } from "../../src/panels/parameters/parameter_tree";

const parameters = new Map<string, string | number>([
  ["/robot", "r2"],
  ["/base/rate", 10],
  ["/base/pid/p", 1.5],
]);
const names = (closed: string[], text = ""): string[] =>
  parameterRows(parameters, new Set(closed), text).map((row) => `${"  ".repeat(row.depth)}${row.label}`);

test("a tree of namespaces, closed and filtered", () => {
  expect(names([])).toEqual(["base", "  pid", "    p", "  rate", "robot"]);
  expect(names(["/base"])).toEqual(["base", "robot"]);
  expect(names(["/base"], "PID")).toEqual(["base", "  pid", "    p"]);
});

test("a parameter keeps its type", () => {
  expect(parameterText(20, true)).toBe("20.0");
  expect(parameterText(20, false)).toBe("20");
  expect(parameterFromText("a", "12", false)).toEqual({ value: "12" });
  expect(parameterFromText(1, "2.5", false)).toEqual({ fault: "This must be a whole number." });
  expect(parameterFromText(1, "−2.5", true)).toEqual({ value: -2.5 });
  expect(parameterFromText([1], "[1, 2]", false)).toEqual({ value: [1, 2] });
  expect(parameterFromText(true, "yes", false)).toEqual({ fault: "This must be true or false." });
  expect(parameterFromText({ a: 1 }, "[]", false)).toEqual({ fault: 'This must be a mapping, as {"a": 1}.' });
});
