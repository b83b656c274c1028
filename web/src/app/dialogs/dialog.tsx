/** A dialog over the page; Esc or a press outside shuts it. */

import type { ComponentChildren, JSX } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";

import { Button } from "../../theme/button";

export interface DialogProps {
  readonly title: string;
  readonly class?: string;
  readonly onClose: () => void;
  readonly children: ComponentChildren;
}

export function Dialog({ title, class: extra = "", onClose, children }: DialogProps): JSX.Element {
  const dialog = useRef<HTMLDialogElement>(null);
  useLayoutEffect(() => {
    // before the next key: it belongs to the dialog
    const before = document.activeElement;
    dialog.current?.showModal();
    return () => {
      if (before instanceof HTMLElement) before.focus();
    };
  }, []);
  return (
    <dialog
      ref={dialog}
      class={`dialog ${extra}`}
      aria-label={title}
      onClose={onClose}
      onPointerDown={(event) => event.target === event.currentTarget && onClose()}
      onKeyDown={(event) => {
        if (event.currentTarget.open) event.stopPropagation(); // a closed dialog may keep the focus until the next frame
      }}
    >
      <div class="tabs">
        <h2>{title}</h2>
        <span class="sp" />
        <Button icon="close" label="Close" small onClick={onClose} />
      </div>
      {children}
    </dialog>
  );
}
