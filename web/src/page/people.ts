/** People at the same page, and their selections. */

import { computed, effect, signal, type ReadonlySignal } from "@preact/signals";

import type { People, Person, SharedSelection } from "../protocol/generated/page_messages";
import type { Connection } from "../protocol/connection";
import type { Selection } from "./page";
import { placed } from "./selection_lookup";

const NOBODY: People = { you: 0, people: [] };
const COLORS = 6;

/** Follow the people at the page, and send them the selection. */
export function followPeople(
  connection: Connection,
  selection: ReadonlySignal<Selection | null>,
): ReadonlySignal<People> {
  const people = signal(NOBODY);
  const hasPeople = computed(() => people.value !== NOBODY);
  connection.subscribeJson("trundle/people", (next) => {
    people.value = next;
  });
  effect(() => {
    if (connection.state.value.kind !== "connected") people.value = NOBODY;
  });
  effect(() => {
    if (hasPeople.value) connection.present(shared(selection.value));
  });
  return people;
}

/** Selection as shown to others; null: nothing of the simulated world. */
function shared(selected: Selection | null): SharedSelection | null {
  const selection = placed(selected);
  switch (selection?.kind) {
    case "model":
    case "link":
    case "joint":
    case "light":
      return selection;
    default:
      return null;
  }
}

export function nameOf({ number }: Person): string {
  return `Person ${number}`;
}

/** Token of the color in which others see a person's selection. */
export function colorOf({ number }: Person): `--${string}` {
  return `--person-${((number - 1) % COLORS) + 1}`;
}

/** All people except the person at this page. */
export function others({ you, people }: People): readonly Person[] {
  return people.filter(({ number }) => number !== you);
}
