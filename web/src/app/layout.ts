/** Open panels and their widths: remembered, and fitted to the window. */

import { computed, effect, signal, type Signal } from "@preact/signals";

import type { Insets } from "../scene/free_area";
import { isBoolean, isNumber, isOneOf, recall, remember } from "../page/storage";

const LEFT = ["world", "displays", "insert"] as const;
const RIGHT = ["inspector", "views", "tool_properties", "lesson"] as const;
export type SideName = "left" | "right";
export type SidePage = (typeof LEFT | typeof RIGHT)[number];
export type SheetHeight = "closed" | "half" | "full";

const PHONE = 641; // px: a narrower window has the phone's page
const ONE_SIDE = 1280; // px: a narrower window shows one side panel at a time
const RAILS = 1000; // px: a narrower window begins with rails on both sides
const RAIL = 32;
const GAPS = 32; // left and right of each side panel
/** Widths of a side panel [px]. */
export const SIDE = { min: 240, max: 288 };
const DOCK = { min: 120, rail: 32, first: 200 };
/** Page height below which the dock begins lower [px], and the share of the missing height that the dock loses. */
const DOCK_SHRINKS = { below: 900, share: 0.3 };
/** Share of the page that a dock as high as its contents covers at most. */
const CONTENTS_SHARE = 1 / 3;
/** Shortest page on which the dock begins open, and height that an open dock leaves: bar, tools, notice and camera tiles [px]. */
const DOCK_OPENS = 560;
const ABOVE_DOCK = 304;
/** Heights of the overlays at the foot of the scene, with their gap: the tiles' pictures are 4 : 3. */
const FOOT = { tiles: 166, drive: 138, phoneDrive: 160 };
/** On a phone, the notice and the tile below it are at the top of the scene. */
const HEAD = { gap: 8, phoneTile: 196 };
/** Smallest height of the scene [px]. */
const MIN_SCENE_HEIGHT = 240;

/** Widths [px] of the side panels, together at most 40 % of the window; null: a rail. */
export function sideWidths(window: number, left: number | null, right: number | null): [number, number] {
  const room = window * 0.4 - GAPS;
  const clamp = (width: number): number => Math.min(SIDE.max, Math.max(SIDE.min, Math.min(width, room)));
  if (left === null || right === null)
    return [left === null ? RAIL : clamp(left), right === null ? RAIL : clamp(right)];
  const first = Math.min(clamp(left), Math.max(SIDE.min, room - SIDE.min));
  const second = Math.min(clamp(right), Math.floor(room - first));
  return second < SIDE.min ? [clamp(left), RAIL] : [first, second];
}

/** Side panel: its current page, whether it is open, and its width [px]. */
class Side {
  readonly page: Signal<SidePage>;
  readonly isOpen: Signal<boolean>;
  readonly width: Signal<number>;

  /** `open`: in a window of this width [px] or more, the panel is as the person left it; otherwise it is a rail. */
  constructor(
    private readonly name: SideName,
    first: SidePage,
    readonly pages: readonly SidePage[],
    kind: string,
    open: { readonly key: string; readonly first: boolean; readonly from: number; readonly in: Signal<number> },
    width: number,
  ) {
    this.page = signal(recall(`${name}.page.${kind}`, first, isOneOf(...pages)));
    this.isOpen = signal(false);
    this.width = signal(recall(`${name}.width`, width, isNumber));
    effect(() => remember(`${name}.page.${kind}`, this.page.value));
    const isWide = computed(() => open.in.value >= open.from);
    effect(() => {
      this.isOpen.value = isWide.value && recall(open.key, open.first, isBoolean);
    });
    effect(() => {
      if (isWide.peek()) remember(open.key, this.isOpen.value);
    });
  }

  resize(width: number): void {
    this.width.value = Math.min(SIDE.max, Math.max(SIDE.min, width));
    remember(`${this.name}.width`, this.width.peek());
  }
}

export class Layout {
  readonly width = signal(innerWidth);
  readonly height = signal(innerHeight);
  readonly left: Side;
  readonly right: Side;
  /** True where the dock begins open: there is a robot to drive, or something to show. */
  readonly dockBegins = signal(false);
  /** Height of the dock's contents and tabs [px]; null: the contents fill any height. */
  readonly dockContents = signal<number | null>(null);
  /** True if the user left the dock open; null: the user never opened or closed it. */
  private readonly dockLeft = signal(innerHeight < DOCK_OPENS ? false : recall("dock.open", null, isBoolean));
  /** Height that the user chose [px]; null: the default. */
  private readonly dockHeight = signal(recall("dock.height", null, isNumber));
  /** Page of the phone's sheet: "world", "displays", "inspector" or a panel's id. */
  readonly sheetPage = signal("world");
  readonly sheetHeight = signal<SheetHeight>("closed");

  readonly isPhone = computed(() => this.width.value < PHONE);
  /** Widths in use [px]. */
  readonly sides = computed(() =>
    sideWidths(
      this.width.value,
      this.left.isOpen.value ? this.left.width.value : null,
      this.right.isOpen.value ? this.right.width.value : null,
    ),
  );
  readonly dockOpen = computed(() => this.dockLeft.value ?? this.dockBegins.value);
  readonly dock = computed(() =>
    this.dockOpen.value ? Math.max(DOCK.min, Math.min(this.wantedDock, this.tallestDock)) : DOCK.rail,
  );

  constructor(kind: "simulation" | "graph" | "log" | "bag") {
    const simulates = kind === "simulation" || kind === "log";
    const open = (key: string, first: boolean, from: number) => ({ key, first, from, in: this.width });
    this.left = new Side("left", simulates ? "world" : "displays", LEFT, kind, open("left.open", true, RAILS), 272);
    this.right = new Side("right", "inspector", RIGHT, kind, open(`right.open.${kind}`, simulates, ONE_SIDE), 280);
    effect(() => this.writeVariables());
  }

  listen(): () => void {
    const resize = (): void => {
      this.width.value = innerWidth;
      this.height.value = innerHeight;
    };
    addEventListener("resize", resize);
    return () => removeEventListener("resize", resize);
  }

  /** Height of the open dock as a person has chosen it, or as its panels and the window want it [px]. */
  private get wantedDock(): number {
    const [contents, chosen, height] = [this.dockContents.value, this.dockHeight.value, this.height.value];
    if (contents !== null) return Math.min(contents, chosen ?? height * CONTENTS_SHARE);
    return chosen ?? DOCK.first - DOCK_SHRINKS.share * Math.max(0, DOCK_SHRINKS.below - height);
  }

  private get tallestDock(): number {
    return Math.min(this.height.value / 2, this.height.value - ABOVE_DOCK);
  }

  /** Height of the phone's sheet and the disc above it [px]; a full sheet hides the scene. */
  private phoneFoot(drive: boolean): number {
    return this.sheetHeight.value === "closed" ? 72 + (drive ? FOOT.phoneDrive : 0) : this.height.value / 2;
  }

  /** Edges of the scene that panels and overlays cover [px]; the scene begins below the bar. */
  insets({ tiles, drive }: { readonly tiles: boolean; readonly drive: boolean }): Insets {
    const [left, right] = this.sides.value;
    if (this.isPhone.value)
      return { left: 0, right: 0, top: tiles ? HEAD.phoneTile : HEAD.gap, bottom: this.phoneFoot(drive) };
    const bottom = this.dock.value + 16;
    const foot = tiles ? FOOT.tiles : drive ? FOOT.drive : 0;
    const isRoom = this.height.value - bottom - foot >= MIN_SCENE_HEIGHT;
    return { left: left + 16, right: right + 16, top: HEAD.gap, bottom: bottom + (isRoom ? foot : 0) };
  }

  /** Width of a side panel now [px]. */
  widthOf(side: SideName): number {
    return this.sides.value[side === "left" ? 0 : 1];
  }

  isRail(side: SideName): boolean {
    return this.widthOf(side) === RAIL;
  }

  /** Open a side panel, or close it. */
  toggle(side: SideName): void {
    if (this.isRail(side)) this.open(this[side].page.peek());
    else this[side].isOpen.value = false;
  }

  /** Show a page of a side panel, or of the phone's sheet. */
  open(page: SidePage): void {
    const isLeft = this.left.pages.includes(page);
    const [side, other] = isLeft ? [this.left, this.right] : [this.right, this.left];
    side.page.value = page;
    side.isOpen.value = true;
    if (this.isPhone.peek()) this.openSheet(isLeft || page === "lesson" ? page : "inspector");
    if (this.width.peek() < ONE_SIDE) other.isOpen.value = false;
  }

  openSheet(page: string): void {
    this.sheetPage.value = page;
    if (this.sheetHeight.peek() === "closed") this.sheetHeight.value = "half";
  }

  openDock(isOpen: boolean): void {
    this.dockLeft.value = isOpen;
    if (this.height.peek() >= DOCK_OPENS) remember("dock.open", isOpen);
  }

  resizeDock(height: number): void {
    this.openDock(height >= DOCK.min / 2);
    this.dockHeight.value = Math.max(DOCK.min, Math.min(height, this.tallestDock));
    remember("dock.height", this.dockHeight.peek());
  }

  /** Insets of the scene's free part, as variables of the style sheets. */
  private writeVariables(): void {
    const [left, right] = this.sides.value;
    const { style } = document.documentElement;
    const phone = this.isPhone.value;
    const px = (name: string, value: number): void => style.setProperty(name, `${Math.round(value)}px`);
    px("--left-now", left);
    px("--right-now", right);
    px("--dock-now", this.dock.value);
    px("--in-l", phone ? 8 : left + 16);
    px("--in-r", phone ? 8 : right + 16);
    px("--in-b", phone ? this.phoneFoot(false) : this.dock.value + 16);
  }
}
