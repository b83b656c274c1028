import { describe, expect, it, vi } from "vitest";

import { OffscreenPicture } from "../../src/scene/offscreen_picture";

const [READ, DRAW, BOTH, BACK, COLOR, DEPTH, UNSIGNALED, SIGNALED] = [1, 2, 3, 4, 5, 6, 7, 8];

/** A context that notes where things are drawn and what is copied. */
class FakeContext {
  readonly READ_FRAMEBUFFER = READ;
  readonly DRAW_FRAMEBUFFER = DRAW;
  readonly FRAMEBUFFER = BOTH;
  readonly BACK = BACK;
  readonly COLOR_ATTACHMENT0 = COLOR;
  readonly DEPTH_ATTACHMENT = DEPTH;
  readonly UNSIGNALED = UNSIGNALED;
  readonly canvas = Object.assign(new EventTarget(), { width: 10, height: 10 });
  /** Where it draws, and from where it reads; null: the canvas. */
  readonly bound: Record<number, unknown> = {};
  readonly copies: unknown[] = [];
  readonly sizes: unknown[] = [];
  chosen: readonly number[] = [];
  status = UNSIGNALED;
  private created = 0;

  bindFramebuffer(target: number, framebuffer: unknown): void {
    for (const part of target === BOTH ? [READ, DRAW] : [target]) this.bound[part] = framebuffer;
  }
  drawBuffers(buffers: readonly number[]): void {
    this.chosen = buffers;
  }
  createFramebuffer(): unknown {
    this.created += 1;
    return `framebuffer ${this.created}`;
  }
  createRenderbuffer(): unknown {
    return {};
  }
  renderbufferStorageMultisample(...[, samples, , width, height]: number[]): void {
    this.sizes.push([width, height, samples]);
  }
  blitFramebuffer(...[left, top, right, bottom]: number[]): void {
    this.copies.push({ from: this.bound[READ], to: this.bound[DRAW], area: [left, top, right, bottom] });
  }
  fenceSync(): unknown {
    return "sync";
  }
  getSyncParameter(): number {
    return this.status;
  }
  bindRenderbuffer(): void {}
  framebufferRenderbuffer(): void {}
  flush(): void {}
  deleteSync(): void {}
}

class FakeCanvas extends EventTarget {
  constructor(
    public width: number,
    public height: number,
  ) {
    super();
  }
}
vi.stubGlobal("OffscreenCanvas", FakeCanvas);

function begun(): { context: FakeContext; picture: OffscreenPicture } {
  const context = new FakeContext();
  const picture = new OffscreenPicture(context as unknown as WebGL2RenderingContext);
  fit(picture, 30, 20);
  return { context, picture };
}

function fit(picture: OffscreenPicture, width: number, height: number, samples = 0): void {
  Object.assign(picture.canvas, { width, height });
  picture.fit(samples);
}

describe("an offscreen picture", () => {
  it("receives drawing to the canvas, and no other framebuffer's", () => {
    const { context } = begun();

    context.bindFramebuffer(BOTH, null);
    context.drawBuffers([BACK]);
    expect([context.bound[DRAW], context.chosen]).toEqual(["framebuffer 1", [COLOR]]);
    context.bindFramebuffer(BOTH, "another");
    expect(context.bound[DRAW]).toBe("another");
  });

  it("is copied to the canvas once it is done, and can be drawn to again", () => {
    const { context, picture } = begun();

    picture.begin();
    expect([picture.isBegun, picture.isDone()]).toEqual([true, false]);
    context.status = SIGNALED;
    expect(picture.isDone()).toBe(true);
    expect(context.canvas.width).toBe(10); // with the picture before
    picture.show();
    expect([context.canvas.width, context.canvas.height]).toEqual([30, 20]);
    expect(picture.isBegun).toBe(false);
    expect(context.copies).toEqual([{ from: "framebuffer 1", to: null, area: [0, 0, 30, 20] }]);
    expect(context.bound[DRAW]).toBe("framebuffer 1");
  });

  it("has new buffers only for a different size or number of samples", () => {
    const { context, picture } = begun();
    const before = context.sizes.length;

    fit(picture, 30, 20);
    expect(context.sizes.length).toBe(before);
    fit(picture, 60, 20);
    fit(picture, 60, 20, 4);
    expect(context.sizes.slice(before)).toEqual([
      [60, 20, 0],
      [60, 20, 0],
      [60, 20, 4],
      [60, 20, 4],
    ]);
  });

  it("is created again in its size when a lost context is restored", () => {
    const { context, picture } = begun();

    picture.begin();
    let created: unknown = null;
    picture.canvas.addEventListener("webglcontextrestored", () => {
      context.bindFramebuffer(BOTH, null);
      created = context.bound[DRAW];
    });
    context.canvas.dispatchEvent(new Event("webglcontextrestored"));
    expect(created).toBe("framebuffer 2"); // before the renderer restarts
    context.bindFramebuffer(BOTH, null);
    expect([context.bound[DRAW], picture.isBegun]).toEqual(["framebuffer 2", false]);
    expect(context.sizes.at(-1)).toEqual([30, 20, 0]);
  });
});
