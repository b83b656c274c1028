import tseslint from "typescript-eslint";

export default tseslint.config(
  { ignores: ["node_modules"] },
  ...tseslint.configs.strictTypeChecked,
  {
    languageOptions: { parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname } },
    rules: {
      "max-lines": ["error", { max: 340 }],
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true, allowBoolean: true }],
      "@typescript-eslint/no-unused-vars": ["error", { argsIgnorePattern: "^_" }],
      "@typescript-eslint/no-confusing-void-expression": ["error", { ignoreArrowShorthand: true }],
    },
  },
  { files: ["src/protocol/generated/*.ts"], rules: { "max-lines": "off" } },
  {
    files: ["src/**/*.ts", "src/**/*.tsx"],
    ignores: ["src/protocol/json.ts"],
    rules: {
      "no-restricted-properties": ["error", { object: "JSON", property: "parse", message: "Use protocol/check.ts." }],
      "no-restricted-syntax": [
        "error",
        { selector: "CallExpression[callee.property.name='json']", message: "Use text() and protocol/check.ts." },
      ],
    },
  },
  { files: ["*.js"], ...tseslint.configs.disableTypeChecked },
);
