/** A text in metres that faces the viewer. */

import {
  CanvasTexture,
  LinearFilter,
  LinearMipmapLinearFilter,
  NoColorSpace,
  Sprite,
  SpriteMaterial,
  SRGBColorSpace,
} from "three";

/** Height of a line on the canvas [px]. */
const LINE_PX = 64;
/**
 * rviz draws Liberation Sans of 24 px with whole-pixel advances; a line has room for the tallest and the lowest letter.
 */
const FONT_PX = 24;
const EM = FONT_PX / 28;
/** Distance of the base line below the top of a line, per height of the line. */
const BASE = 23.5 / 28;
/** Vertical scale: rviz fits letters to whole pixels, which makes them lower. */
const SQUASH = 17 / 18;
const FONT = `${LINE_PX * EM}px "Liberation Sans", Arial, Helvetica, sans-serif`;
/** rviz's gap between lines [m]. */
const GAP = 0.01;
const LARGEST_PX = 4096;

export class TextBillboard extends Sprite {
  private readonly texture: CanvasTexture;

  /** Lines are `height` high [m]; color 0…1. The text's middle is at its position. */
  constructor(text: string, height: number, rgba: readonly [number, number, number, number]) {
    const [red, green, blue, alpha] = rgba;
    const lines = text.split("\n");
    const whole = lines.length * height + (lines.length - 1) * GAP;
    const canvas = drawText(lines, LINE_PX * (1 + GAP / Math.max(height, GAP)));
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = NoColorSpace;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.magFilter = LinearFilter;
    super(
      new SpriteMaterial({
        map: texture,
        transparent: true,
        depthWrite: false,
        opacity: alpha,
        toneMapped: false,
        alphaTest: 0.02,
      }),
    );
    this.material.color.setRGB(red, green, blue, SRGBColorSpace);
    this.texture = texture;
    this.scale.set((whole * canvas.width) / canvas.height, whole, 1);
  }

  override dispose(): void {
    this.texture.dispose();
    this.material.dispose();
  }
}

/** Canvas with white letters on a transparent background, as large as the text; lines are `pitch` apart [px]. */
function drawText(lines: readonly string[], pitch: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  const pen = canvas.getContext("2d");
  if (pen === null) return canvas;
  pen.font = FONT;
  const advance = advances(pen);
  const widths = lines.map((line) => Array.from(line).reduce((sum, letter) => sum + advance(letter), 0));
  canvas.width = Math.min(LARGEST_PX, Math.max(1, Math.ceil(Math.max(...widths))));
  canvas.height = Math.min(LARGEST_PX, Math.round((lines.length - 1) * pitch + LINE_PX));
  pen.font = FONT; // resizing a canvas resets its font
  pen.fillStyle = "white";
  pen.scale(1, SQUASH);
  lines.forEach((line, index) => {
    let x = 0;
    for (const letter of line) {
      if (letter !== " ") pen.fillText(letter, x, (index * pitch + BASE * LINE_PX) / SQUASH);
      x += advance(letter);
    }
  });
  return canvas;
}

/** Widths of letters [px]; a space is as wide as an A. */
function advances(pen: CanvasRenderingContext2D): (letter: string) => number {
  const unit = (LINE_PX * EM) / FONT_PX;
  const known = new Map<string, number>();
  return (letter) => {
    const width = known.get(letter) ?? Math.round(pen.measureText(letter === " " ? "A" : letter).width / unit) * unit;
    known.set(letter, width);
    return width;
  };
}
