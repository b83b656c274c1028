/** rviz's colors of occupancy, for each byte of a map: 0…100 per cent, 255 unknown, others not allowed. */

export const COLOR_SCHEMES = ["map", "costmap", "raw"] as const;
export type ColorScheme = (typeof COLOR_SCHEMES)[number];

type Rgba = readonly [number, number, number, number];
const UNKNOWN: Rgba = [0x70, 0x89, 0x86, 255];
const INSCRIBED: Rgba = [0, 255, 255, 255];
const LETHAL: Rgba = [255, 0, 255, 255];

/** 256 colors, four bytes each. */
export function palette(scheme: ColorScheme): Uint8Array<ArrayBuffer> {
  const colorOf = { map: mapColor, costmap: costColor, raw: rawColor }[scheme];
  return new Uint8Array(Array.from({ length: 256 }, (_, value) => colorOf(value)).flat());
}

function rawColor(value: number): Rgba {
  return [value, value, value, 255];
}

function mapColor(value: number): Rgba {
  if (value > 100) return illegalColor(value);
  const grey = 255 - Math.floor((255 * value) / 100);
  return [grey, grey, grey, 255];
}

function costColor(value: number): Rgba {
  if (value === 0) return [0, 0, 0, 0];
  if (value > 100) return illegalColor(value);
  if (value === 99) return INSCRIBED;
  if (value === 100) return LETHAL;
  const red = Math.floor((255 * value) / 100);
  return [red, 0, 255 - red, 255];
}

/** Green above 100, red to yellow below −1. */
function illegalColor(value: number): Rgba {
  if (value === 255) return UNKNOWN;
  return value < 128 ? [0, 255, 0, 255] : [255, Math.floor((255 * (value - 128)) / (254 - 128)), 0, 255];
}
