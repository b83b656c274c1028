/** The one tooltip of the page: names of controls with `data-tip`, on hover and on keyboard focus. */

import type { JSX } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";

import { placeBelow } from "./menu_list";

const DELAY = 400; // ms of rest before it shows

export function Tooltips(): JSX.Element | null {
  const [owner, setOwner] = useState<HTMLElement | null>(null);
  const tip = useRef<HTMLDivElement>(null);
  useEffect(() => {
    let timer = 0;
    const show = (event: Event): void => {
      clearTimeout(timer);
      const element = event.target instanceof Element ? event.target.closest<HTMLElement>("[data-tip]") : null;
      if (event.type === "focusin" && element?.matches(":focus-visible") !== true) return;
      if (element === null) setOwner(null);
      else timer = window.setTimeout(() => setOwner(element), DELAY);
    };
    const hide = (): void => {
      clearTimeout(timer);
      setOwner(null);
    };
    const shows = ["pointerover", "focusin"] as const;
    const hides = ["pointerdown", "keydown", "focusout"] as const;
    for (const kind of shows) addEventListener(kind, show);
    for (const kind of hides) addEventListener(kind, hide);
    return () => {
      hide();
      for (const kind of shows) removeEventListener(kind, show);
      for (const kind of hides) removeEventListener(kind, hide);
    };
  }, []);
  useLayoutEffect(() => {
    if (tip.current !== null && owner !== null) placeBelow(tip.current, owner);
  }, [owner]);
  const text = owner?.isConnected === true ? owner.dataset["tip"] : undefined;
  if (text === undefined) return null;
  return (
    <div ref={tip} class="tip" role="tooltip">
      {text}
    </div>
  );
}
