/** Names that are cut in their middle where they have no room: names of one kind begin alike, and differ later. */

import type { JSX } from "preact";

/** Number of characters kept at the end, and the length up to which a name is cut at its end instead. */
const TAIL = 8;
const SHORT = 14;
const SHORTEST_HEAD = 3;
/** Values of a joint, before which names of joints differ. */
const QUANTITY = /\.(position|velocity|effort)$/;
/** Scripts whose letters join, so that a word must not be cut. */
const JOINED = /[\p{Script=Arabic}\p{Script=Syriac}\p{Script=Mongolian}\p{Script=Devanagari}\p{Script=Bengali}]/u;

interface NameProps {
  readonly text: string;
  readonly class?: string;
  /** Names beside it; its kept end begins where it differs from all of them. */
  readonly beside?: readonly string[];
}

export function Name({ text, class: extra = "n", beside = [] }: NameProps): JSX.Element {
  const at = cutAt(text, beside);
  if (at === text.length)
    return (
      <span class={extra} dir="auto">
        {text}
      </span>
    );
  return (
    <span class={`${extra} cut`} dir="auto">
      <span class="head">{text.slice(0, at)}</span>
      <span class="tail">{text.slice(at)}</span>
    </span>
  );
}

/** Index at which the kept end begins; the text's length: the name is cut at its end. */
export function cutAt(text: string, beside: readonly string[] = []): number {
  const usual = usualCut(text);
  if (usual === text.length || JOINED.test(text)) return usual;
  const common = Math.max(0, ...beside.filter((name) => name !== text).map((name) => commonLength(text, name)));
  return common < SHORTEST_HEAD ? usual : Math.min(usual, common);
}

/** Length of the common beginning of two names, in whole characters. */
function commonLength(a: string, b: string): number {
  let length = 0;
  for (const { segment, index } of new Intl.Segmenter().segment(a)) {
    if (!b.startsWith(segment, index)) break;
    length = index + segment.length;
  }
  return length;
}

function usualCut(text: string): number {
  if (text.length <= SHORT) return text.length;
  if (JOINED.test(text)) return /[\s_./:-][\p{N}\p{P}]*$/u.exec(text)?.index ?? text.length;
  const starts = [...new Intl.Segmenter().segment(text)].map(({ index }) => index);
  const kept = TAIL + (QUANTITY.exec(text)?.[0].length ?? 0);
  return starts.length <= Math.max(SHORT, kept + 1) ? text.length : (starts.at(-kept) ?? text.length);
}
