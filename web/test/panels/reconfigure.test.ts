import { expect, test } from "vitest";

import { parseLiteral } from "../../src/panels/reconfigure/python_literal";
import { configValues, describedGroups, hasSlider, setRequest } from "../../src/panels/reconfigure/reconfigure_config";

test("python's literals", () => {
  expect(parseLiteral(`{'a': [1, -2.5, True], u"b": None, 'c': ('it\\'s',)}`)).toEqual({
    a: [1, -2.5, true],
    b: null,
    c: ["it's"],
  });
  for (const bad of ["{'a': }", "[1", "'open", "__import__('os')", "1 2", "constructor", "[".repeat(100_000)])
    expect(parseLiteral(bad)).toBeUndefined();
});

const EDIT = `{'enum_description': 'Size', 'enum': [{'srcline': 9, 'description': 'A small one', 'value': 0, 'type': 'int', 'name': 'Small'}]}`;
const config = (
  doubles: readonly { name: string; value: number }[],
  ints: readonly { name: string; value: number }[] = [],
) => ({
  bools: [{ name: "on", value: true }],
  ints,
  strs: [],
  doubles,
  groups: [],
});
const description = {
  groups: [
    {
      name: "Default",
      type: "",
      parent: 0,
      id: 0,
      parameters: [
        { name: "rate", type: "double", level: 0, description: "Rate [Hz]", edit_method: "" },
        { name: "size", type: "int", level: 0, description: "", edit_method: EDIT },
        { name: "on", type: "bool", level: 0, description: "", edit_method: "" },
      ],
    },
  ],
  min: config([{ name: "rate", value: 1 }], [{ name: "size", value: 0 }]),
  max: config([{ name: "rate", value: 50 }], [{ name: "size", value: 3 }]),
  dflt: config([{ name: "rate", value: 10 }], [{ name: "size", value: 0 }]),
};

test("a description becomes groups of options with limits and choices", () => {
  const [group] = describedGroups(description);
  const [rate, size, on] = group?.options ?? [];
  expect(rate).toMatchObject({ name: "rate", type: "double", lower: 1, upper: 50, initial: 10, choices: [] });
  expect(size?.choices).toEqual([{ name: "Small", value: 0, description: "A small one" }]);
  expect(on).toMatchObject({ type: "bool", lower: null, initial: true });
  expect([rate, size, on].map((option) => option && hasSlider(option))).toEqual([true, true, false]);
});

test("one option is set by a config of that alone", () => {
  const [rate] = describedGroups(description)[0]?.options ?? [];
  const request = rate && setRequest(rate, 20);
  expect(request).toEqual({
    config: { bools: [], ints: [], strs: [], doubles: [{ name: "rate", value: 20 }], groups: [] },
  });
  expect(configValues(request?.["config"])).toEqual(new Map([["rate", 20]]));
});
