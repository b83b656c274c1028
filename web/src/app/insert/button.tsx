/** A button that inserts an item: by a drag into the scene, by a press and a click there, or by Enter in the middle. */

import type { ComponentChildren, JSX, TargetedPointerEvent } from "preact";
import { useRef } from "preact/hooks";

import type { Insertable } from "../../page/insertable";
import type { Shell } from "../shell";

/** Shorter drags of the pointer are presses [px]. */
const CLICK = 4;

export interface InsertButtonProps {
  readonly shell: Shell;
  readonly item: Insertable;
  readonly class: string;
  readonly tip?: string;
  readonly children: ComponentChildren;
}

export function InsertButton({ shell, item, class: name, tip, children }: InsertButtonProps): JSX.Element {
  const { scene, tools } = shell.page;
  const from = useRef<{ readonly x: number; readonly y: number } | null>(null);
  const isDragged = useRef(false);
  const chosen = shell.insertion.typed.value ?? tools.insert?.chosen.value ?? null;
  const isChosen = chosen?.kind === item.kind && chosen.name === item.name;
  const move = (event: TargetedPointerEvent<HTMLButtonElement>): void => {
    const { current: start } = from;
    if (start === null) return;
    if (!isDragged.current && Math.hypot(event.clientX - start.x, event.clientY - start.y) > CLICK) {
      isDragged.current = true;
      shell.insertion.choose(item);
    }
    const at = isDragged.current ? inScene(scene.element, event) : null;
    if (at === null) tools.insert?.hide();
    else tools.insert?.hover(...at);
  };
  const end = (event: TargetedPointerEvent<HTMLButtonElement>): void => {
    from.current = null;
    if (!isDragged.current) return;
    const at = event.type === "pointerup" ? inScene(scene.element, event) : null;
    if (at === null) tools.use("rviz/Interact");
    else tools.insert?.place(...at);
  };
  return (
    <button
      type="button"
      class={isChosen ? `${name} on` : name}
      aria-label={`Insert ${item.title}`}
      aria-pressed={isChosen}
      data-tip={tip}
      onPointerDown={(event) => {
        isDragged.current = false;
        if (event.button !== 0 || !shell.isDrawn.peek()) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        from.current = { x: event.clientX, y: event.clientY };
      }}
      onPointerMove={move}
      onPointerUp={end}
      onPointerCancel={end}
      onClick={({ detail }) => {
        if (isDragged.current) return;
        shell.insertion.choose(item);
        if (detail === 0 && shell.isDrawn.peek()) tools.insert?.placeInMiddle(); // by the keyboard
      }}
    >
      {children}
    </button>
  );
}

/** Position of a pointer in the scene [px]; null: it is over another element. */
function inScene(element: HTMLElement, { clientX, clientY }: PointerEvent): [number, number] | null {
  const { left, top } = element.getBoundingClientRect();
  return document.elementFromPoint(clientX, clientY) === element ? [clientX - left, clientY - top] : null;
}
