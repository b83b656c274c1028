/** Light or dark theme: the choice made here, otherwise the browser's preference. */

import { effect, signal, type Signal } from "@preact/signals";

import { isOneOf, recall, remember } from "../page/storage";

export type Theme = "light" | "dark";

export function makeTheme(): Signal<Theme> {
  const light = matchMedia("(prefers-color-scheme: light)");
  const preferred = (): Theme => (light.matches ? "light" : "dark");
  const chosen = recall("theme", null, isOneOf<Theme>("light", "dark") as (value: unknown) => value is Theme | null);
  const theme = signal<Theme>(chosen ?? preferred());
  light.addEventListener("change", () => {
    if (recall("theme", "", isOneOf("", "light", "dark")) === "") theme.value = preferred();
  });
  effect(() => {
    document.documentElement.dataset["theme"] = theme.value;
  });
  return theme;
}

export function switchTheme(theme: Signal<Theme>): void {
  theme.value = theme.peek() === "dark" ? "light" : "dark";
  remember("theme", theme.peek());
}
