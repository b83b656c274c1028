// @vitest-environment jsdom
/** A field whose value changes while a person is in it. */

import { render, type JSX } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, expect, it, vi } from "vitest";

import { TextField } from "../../src/theme/text_field";

const commit = vi.fn<(text: string) => void>();
let host: HTMLElement;

function Field({ value }: { readonly value: string }): JSX.Element {
  return <TextField label="z" value={value} onCommit={commit} />;
}

function show(value: string): HTMLInputElement {
  void act(() => {
    render(<Field value={value} />, host);
  });
  const input = host.querySelector("input");
  if (input === null) throw new Error("there is no field");
  return input;
}

function focus(input: HTMLInputElement): void {
  void act(() => {
    input.focus();
  });
}

/** In place of what is selected, as keys do. */
function type(input: HTMLInputElement, text: string): void {
  void act(() => {
    input.setRangeText(text);
    input.dispatchEvent(new Event("input", { bubbles: true }));
  });
}

function press(input: HTMLInputElement, key: string): void {
  void act(() => {
    input.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  });
}

function selected(input: HTMLInputElement): string {
  return input.value.slice(input.selectionStart ?? 0, input.selectionEnd ?? 0);
}

beforeEach(() => {
  host = document.body.appendChild(document.createElement("div"));
  commit.mockClear();
});
afterEach(() => {
  void act(() => {
    render(null, host);
  });
  host.remove();
});

it("shows its value as it changes", () => {
  expect(show("1").value).toBe("1");
  expect(show("2").value).toBe("2");
});

it("keeps its value, selected, while focused, so that typing replaces it", () => {
  focus(show("1.25"));
  const input = show("1.5");
  expect([input.value, selected(input)]).toEqual(["1.25", "1.25"]);
  type(input, "3");
  show("1.75");
  press(input, "Enter");
  expect(commit.mock.calls).toEqual([["3"]]);
});

it("shows its value again after Enter, selected", () => {
  const input = show("1");
  focus(input);
  type(input, "3");
  press(input, "Enter");
  show("2.5");
  expect([input.value, selected(input)]).toEqual(["2.5", "2.5"]);
});

it("commits typed text on blur, and nothing else", () => {
  const input = show("1");
  focus(input);
  show("2");
  void act(() => {
    input.blur();
  });
  expect([input.value, commit.mock.calls]).toEqual(["2", []]);
  focus(input);
  type(input, "3");
  void act(() => {
    input.blur();
  });
  expect(commit.mock.calls).toEqual([["3"]]);
});

it("is unchanged after Escape", () => {
  const input = show("1");
  focus(input);
  type(input, "3");
  press(input, "Escape");
  expect([input.value, commit.mock.calls]).toEqual(["1", []]);
});
