/** Icons on a grid of 16 px, drawn with strokes of 1.5 px; `f` marks a filled path. */

import type { JSX } from "preact";

type Shape =
  | string
  | { readonly fill: string }
  | { readonly circle: readonly [number, number, number] }
  | { readonly dash: string };

const ICONS = {
  play: [{ fill: "M4.5 3v10l8.5-5z" }],
  pause: [{ fill: "M4 3h3v10H4zM9 3h3v10H9z" }],
  step: [{ fill: "M3.5 3.5v9L10 8z" }, "M12 3.5v9"],
  record: [{ fill: "M8 3.500a4.500 4.500 0 1 0 .01 0z" }],
  reset: ["M3.2 8a4.8 4.8 0 1 0 1.6-3.6M3 2.5v3h3"],
  down: ["M4 6l4 4 4-4"],
  right: ["M6 4l4 4-4 4"],
  timeline: ["M2 13h12M3.5 13v-2.5M6.5 13v-2.5M13 13v-2.5M9.8 13V6", { fill: "M7.3 2.5h5L9.8 6.5z" }],
  sun: [
    { circle: [8, 8, 3] },
    "M8 1.5v1.2M8 13.3v1.2M1.5 8h1.2M13.3 8h1.2M3.4 3.4l.9.9M11.7 11.7l.9.9M12.6 3.4l-.9.9M4.3 11.7l-.9.9",
  ],
  moon: ["M13 9.6A5.6 5.6 0 0 1 6.4 3 5.6 5.6 0 1 0 13 9.6z"],
  find: [{ circle: [7, 7, 4] }, "M10 10l3.5 3.5"],
  world: [{ circle: [8, 8, 5.8] }, "M2.2 8h11.6M8 2.2c3.4 3.6 3.4 8 0 11.6M8 2.2c-3.4 3.6-3.4 8 0 11.6"],
  model: ["M8 2l5.2 3v6L8 14l-5.2-3V5zM2.8 5L8 8l5.2-3M8 8v6"],
  sphere: [{ circle: [8, 8, 5.8] }, "M2.200 8c2.500 2.200 9.100 2.200 11.600 0"],
  cylinder: ["M3.500 4.300c0-2.400 9-2.400 9 0v7.400c0 2.400-9 2.400-9 0zM3.500 4.300c0 2.400 9 2.400 9 0"],
  spot: ["M6 2h4l1 4H5zM5 6l-3 8M11 6l3 8M8 8.500v2M8 12.500v1.500"],
  link: ["M4 5h8a1 1 0 0 1 1 1v4.500a1 1 0 0 1-1 1H4a1 1 0 0 1-1-1V6a1 1 0 0 1 1-1z"],
  joint: [{ circle: [8, 8, 2.2] }, "M2 8h3.8M10.2 8H14"],
  camera: ["M2 5.2h7.5v6H2zM9.5 7.2l4-2v6l-4-2"],
  sensor: [
    { circle: [8, 8, 1.5] },
    "M5 11a4.2 4.2 0 0 1 0-6M11 5a4.2 4.2 0 0 1 0 6M3 13a7 7 0 0 1 0-10M13 3a7 7 0 0 1 0 10",
  ],
  light: ["M6 12h4M6.5 14h3M8 2a3.8 3.8 0 0 0-2 7v1h4V9a3.8 3.8 0 0 0-2-7z"],
  plugin: ["M6 2v3M10 2v3M4 5h8v3a4 4 0 0 1-8 0zM8 12v2.5"],
  frame: ["M4 12V3M4 12h9M4 12l5-5"],
  eye: ["M1.8 8S4 4 8 4s6.2 4 6.2 4-2.2 4-6.2 4-6.200-4-6.200-4z", { circle: [8, 8, 1.8] }],
  eye_off: [
    "M3 3l10 10M6 4.300C6.600 4.100 7.300 4 8 4c4 0 6.200 4 6.200 4s-.7 1.200-1.900 2.300M4 5.500C2.600 6.600 1.800 8 1.800 8S4 12 8 12c.9 0 1.700-.2 2.400-.5",
  ],
  people: [
    { circle: [6, 5.5, 2.5] },
    "M1.8 13.500a4.200 4.200 0 0 1 8.400 0M10.500 3.300a2.300 2.300 0 0 1 0 4.400M12 9.900a4 4 0 0 1 2.300 3.600",
  ],
  close: ["M4 4l8 8M12 4l-8 8"],
  collapse_left: ["M3 2.5v11M12 4.5L8.5 8l3.5 3.5"],
  collapse_right: ["M13 2.5v11M4 4.5L7.5 8 4 11.5"],
  collapse_down: ["M2.5 13h11M4.5 4L8 7.5 11.5 4"],
  expand_up: ["M2.5 13h11M4.5 8.500L8 5l3.500 3.500"],
  undo: ["M3 6.5h6.5a3.5 3.5 0 0 1 0 7H6M3 6.5l3-3M3 6.5l3 3"],
  redo: ["M13 6.5H6.5a3.5 3.5 0 0 0 0 7H10M13 6.5l-3-3M13 6.5l-3 3"],
  edit: ["M3 13l.7-3L10.5 3.2l2.3 2.3L6 12.300z"],
  select: ["M4 2.5l8.5 5-3.8 1L7 12.5z"],
  move: [
    "M8 2v12M2 8h12M8 2L6.3 3.7M8 2l1.7 1.7M8 14l-1.7-1.7M8 14l1.7-1.7M2 8l1.7-1.7M2 8l1.7 1.7M14 8l-1.7-1.7M14 8l-1.7 1.7",
  ],
  push: ["M2 8h8M7 5l3 3-3 3M13 3v10"],
  rotate: ["M13 8a5 5 0 1 1-1.7-3.7M13 2.500v3h-3"],
  measure: ["M2.5 10.5l8-8 3 3-8 8zM5 8l1.300 1.300M7 6l1.300 1.300M9 4l1.300 1.300"],
  plus: ["M8 3v10M3 8h10"],
  camera_move: [
    "M13.5 8a5.5 5.500 0 1 1-11 0a5.500 5.500 0 0 1 11 0zM2.500 8a5.500 2.200 0 0 0 11 0a5.500 2.200 0 0 0-11 0",
  ],
  focus: ["M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3", { circle: [8, 8, 1.5] }],
  interact: [
    "M6 8.5V3.300a1.200 1.200 0 0 1 2.400 0V7l3.300.8a1.700 1.700 0 0 1 1.300 1.900L12.500 13H7L4 9.600a1.100 1.100 0 0 1 1.700-1.300",
  ],
  box: [{ dash: "M3 3h10v10H3z" }],
  pose: [{ circle: [8, 10, 3.5] }, "M8 10V2.500M5.500 5L8 2.500 10.500 5"],
  goal: ["M4 14V2.500M4 3h8.500l-2.300 3 2.300 3H4"],
  point: ["M8 14S4 9.600 4 6.500a4 4 0 0 1 8 0C12 9.600 8 14 8 14z", { circle: [8, 6.5, 1.3] }],
  enlarge: ["M9.5 2.500h4v4M13.500 2.500l-5 5M6.500 13.500h-4v-4M2.500 13.500l5-5"],
  panes: ["M2.500 3.500h11v9h-11zM8 3.500v9M2.500 8h11"],
  dots: [{ fill: "M3 7h2v2H3zM7 7h2v2H7zM11 7h2v2h-2z" }],
  share: [
    { circle: [4, 8, 1.8] },
    { circle: [12, 3.8, 1.8] },
    { circle: [12, 12.2, 1.8] },
    "M5.6 7.1l4.8-2.4M5.6 8.9l4.8 2.4",
  ],
  upload: ["M8 10V2.500M5 5.500l3-3 3 3M3 13h10"],
  download: ["M8 2.500v7M5 7l3 3 3-3M3 13h10"],
  filter: ["M2.500 3.500h11L9.500 8.500V13l-3-1.500v-3z"],
  plots: ["M2.500 13.500V2.500M2.500 13.500h11M4.500 10l3-4 2.500 2.500 3-4.500"],
  log: ["M3 4h10M3 8h10M3 12h6"],
  layers: ["M8 2.500l6 3-6 3-6-3zM2 8.500l6 3 6-3"],
  group: ["M2.500 5v7.500h11V5H8L6.500 3.500h-4z"],
  copy: ["M5.500 5.500h8v8h-8zM10.500 5.500v-3h-8v8h3"],
  lesson: [
    "M8 4C6.500 2.800 4.500 2.500 2 2.500v10c2.500 0 4.500.300 6 1.500 1.500-1.200 3.500-1.500 6-1.500v-10c-2.500 0-4.500.300-6 1.500zM8 4v10",
  ],
  back: ["M10 3.500L5.500 8l4.500 4.500"],
  check: ["M3 8.500l3.500 3.500L13 4.500"],
  keyboard: ["M2 4.500h12v7H2zM4.500 7h.01M7 7h.01M9.500 7h.01M12 7h.01M5 9.500h6"],
  disc: [{ circle: [8, 8, 5.5] }, { circle: [8, 8, 1.8] }],
} satisfies Record<string, readonly Shape[]>;

export type IconName = keyof typeof ICONS;

export function isIcon(name: string): name is IconName {
  return name in ICONS;
}

function draw(shape: Shape): JSX.Element {
  if (typeof shape === "string") return <path key={shape} d={shape} />;
  if ("fill" in shape) return <path key={shape.fill} class="f" d={shape.fill} />;
  if ("dash" in shape) return <path key={shape.dash} d={shape.dash} stroke-dasharray="2 2" />;
  const [x, y, radius] = shape.circle;
  return <circle key={`${x} ${y} ${radius}`} cx={x} cy={y} r={radius} />;
}

/** An icon beside a text, or in a control that has a name. */
export function Icon({ name, class: extra = "" }: { readonly name: IconName; readonly class?: string }): JSX.Element {
  const shapes: readonly Shape[] = ICONS[name];
  return (
    <svg class={`i ${extra}`} viewBox="0 0 16 16" aria-hidden="true">
      {shapes.map(draw)}
    </svg>
  );
}
