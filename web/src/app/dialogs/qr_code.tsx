/** A text as a QR code, black on white in every theme: many cameras do not read an inverted one. */

import type { JSX } from "preact";
import { useMemo } from "preact/hooks";
import { encode } from "uqr";

/** Blank modules around a code, as ISO 18004 asks for. */
const BORDER = 4;

export function QrCode({ label, text }: { readonly label: string; readonly text: string }): JSX.Element {
  const { data, size } = useMemo(() => encode(text, { ecc: "M", border: BORDER }), [text]);
  const path = data
    .flatMap((row, y) => row.map((isDark, x) => (isDark ? `M${String(x)} ${String(y)}h1v1h-1z` : "")))
    .join("");
  return (
    <svg class="qr" role="img" aria-label={label} viewBox={`0 0 ${String(size)} ${String(size)}`}>
      <rect width={size} height={size} fill="#fff" />
      <path d={path} fill="#000" shape-rendering="crispEdges" />
    </svg>
  );
}
