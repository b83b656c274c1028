/** Names that are cut in their middle where they have no room: names of one kind begin alike, and differ at the end. */

import type { JSX } from "preact";

/** Number of characters kept at the end, and the length up to which a name is cut at its end instead. */
const TAIL = 8;
const SHORT = 14;
/** Values of a joint, before which names of joints differ. */
const QUANTITY = /\.(position|velocity|effort)$/;
/** Scripts whose letters join, so that a word must not be cut. */
const JOINED = /[\p{Script=Arabic}\p{Script=Syriac}\p{Script=Mongolian}\p{Script=Devanagari}\p{Script=Bengali}]/u;

export function Name({ text, class: extra = "n" }: { readonly text: string; readonly class?: string }): JSX.Element {
  const at = cutAt(text);
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
export function cutAt(text: string): number {
  if (text.length <= SHORT) return text.length;
  if (JOINED.test(text)) return /[\s_./:-][\p{N}\p{P}]*$/u.exec(text)?.index ?? text.length;
  const starts = [...new Intl.Segmenter().segment(text)].map(({ index }) => index);
  const kept = TAIL + (QUANTITY.exec(text)?.[0].length ?? 0);
  return starts.length <= Math.max(SHORT, kept + 1) ? text.length : (starts.at(-kept) ?? text.length);
}
