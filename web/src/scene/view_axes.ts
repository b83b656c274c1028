/** The axes at the top right: they show the camera's orientation; a press on an end looks from that side. */

import { Matrix4, Vector3 } from "three";

import type { SixSides } from "./view_controller";

const SVG = "http://www.w3.org/2000/svg";
const RADIUS = 30;
const LENGTH = 21;

interface Tip {
  readonly axis: Vector3;
  readonly side: SixSides;
  readonly group: SVGGElement;
  readonly line: SVGLineElement | null;
}

/** Ends of the axes with the side that faces each: x is forward, so its end faces the front. */
const ENDS = [
  { letter: "x", axis: [1, 0, 0], side: "front" },
  { letter: "y", axis: [0, 1, 0], side: "left" },
  { letter: "z", axis: [0, 0, 1], side: "top" },
  { letter: "", axis: [-1, 0, 0], side: "back", of: "x" },
  { letter: "", axis: [0, -1, 0], side: "right", of: "y" },
  { letter: "", axis: [0, 0, -1], side: "bottom", of: "z" },
] as const;

export class ViewAxes {
  /** Width and height [px]. */
  static readonly size = 62;
  readonly element = make("svg", {
    width: `${ViewAxes.size}`,
    height: `${ViewAxes.size}`,
    viewBox: "-31 -31 62 62",
    role: "group",
    "aria-label": "View axes",
  });
  private readonly tips: Tip[];
  private readonly turned = new Vector3();
  private order = "";
  /** Shown orientation of the camera. */
  private readonly shown = new Matrix4();

  constructor(onPress: (side: SixSides) => void) {
    Object.assign(this.element.style, { position: "absolute", touchAction: "none" });
    const disc = {
      r: `${RADIUS}`,
      style: "fill: color-mix(in srgb, var(--panel) 80%, transparent); stroke: var(--line-hard)",
    };
    this.element.append(make("circle", disc));
    this.tips = ENDS.map((end) => this.addTip(end, onPress));
  }

  private addTip(end: (typeof ENDS)[number], onPress: (side: SixSides) => void): Tip {
    const color = `var(--${"of" in end ? end.of : end.letter})`;
    const line = end.letter === "" ? null : make("line", { style: `stroke: ${color}; stroke-width: 2` });
    const name = `Look from ${end.side === "top" || end.side === "bottom" ? end.side : `the ${end.side}`}`;
    const group = make("g", {
      role: "button",
      tabindex: "0",
      "aria-label": name,
      style: "cursor: pointer; outline-offset: 1px",
    });
    const title = make("title", {});
    title.textContent = name;
    group.append(title, make("circle", { r: "9", style: "fill: transparent" }));
    group.append(
      make("circle", {
        r: end.letter === "" ? "3.5" : "7",
        style: `fill: ${color}; opacity: ${end.letter === "" ? 0.6 : 1}`,
      }),
    );
    if (end.letter !== "") {
      const style = "fill: var(--panel); font: 700 10px var(--font); text-anchor: middle; pointer-events: none";
      const text = make("text", { y: "3.3", style });
      text.textContent = end.letter;
      group.append(text);
    }
    group.addEventListener("click", () => {
      onPress(end.side);
    });
    group.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      onPress(end.side);
    });
    return { axis: new Vector3(...end.axis), side: end.side, group, line };
  }

  /** Turn with the camera; `view` is the inverse of its pose; nearer ends cover farther ones. */
  show(view: Matrix4): void {
    if (this.shown.equals(view) && this.order !== "") return;
    this.shown.copy(view);
    const placed = this.tips.map((tip) => {
      const at = this.turned.copy(tip.axis).transformDirection(view);
      const [x, y, depth] = [LENGTH * at.x, -LENGTH * at.y, at.z];
      tip.group.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
      tip.line?.setAttribute("x2", x.toFixed(2));
      tip.line?.setAttribute("y2", y.toFixed(2));
      return { tip, depth };
    });
    placed.sort((a, b) => a.depth - b.depth);
    const order = placed.map(({ tip }) => tip.side).join(" ");
    if (order === this.order) return; // an element that is moved loses the focus
    this.order = order;
    for (const { tip } of placed) this.element.append(...(tip.line === null ? [] : [tip.line]), tip.group);
  }
}

function make<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Readonly<Record<string, string>>,
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}
