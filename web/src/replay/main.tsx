/** Replay that plays in a single file: the document contains the world and its motion. */

import "../scene/conventions";
import "../theme/tokens.css";
import "../theme/base.css";
import "../theme/controls.css";
import "./replay.css";

import { effect } from "@preact/signals";
import { render } from "preact";

import { read } from "../protocol/check";
import { replayAbout } from "../protocol/generated/page_checks";
import type { ReplayAbout } from "../protocol/generated/page_messages";
import { linkedView } from "../app/views/view_link";
import { ORIGIN } from "../scene/views/view";
import { SceneInput } from "../scene/pointer_input";
import { ThreeScene } from "../scene/three_scene";
import { ViewList } from "../scene/views/view_list";
import { Bar } from "./bar";
import { Player } from "./player";
import { RecordedWorld, unpacked } from "./recorded_world";

/** First view of a recording without a view [rad]. */
const FIRST_LOOK: Readonly<Record<string, number>> = { Yaw: -1.05, Pitch: 0.4 };

async function start(root: HTMLElement): Promise<void> {
  const about = read(textOf("about"), "the recording", replayAbout);
  followTheme();
  const host = Object.assign(document.createElement("div"), { className: "replay-scene" });
  const bar = document.createElement("div");
  root.append(host, bar);
  const scene = new ThreeScene(host);
  const views = new ViewList(scene, () => ORIGIN);
  new SceneInput(scene, views, () => false);
  const world = await RecordedWorld.read(scene, await unpacked(textOf("world")), about.scene);
  const player = new Player(about.end - about.start);
  effect(() => world.show(player.time.value));
  scene.onTick((elapsed) => player.advance(elapsed));
  lookFirst(views, about, world);
  addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target instanceof HTMLSelectElement || event.target instanceof HTMLButtonElement)
      return;
    event.preventDefault();
    player.toggle();
  });
  render(<Bar player={player} title={about.title} start={about.start} />, bar);
}

/** Set the first view: the address', the file's, otherwise one of the moving bodies. */
function lookFirst(views: ViewList, { view }: ReplayAbout, world: RecordedWorld): void {
  const first = linkedView(location.hash) ?? view;
  if (first !== null) {
    views.load({ Current: first });
    return;
  }
  for (const property of views.current.peek().properties) {
    const angle = FIRST_LOOK[property.name];
    if (angle !== undefined) property.decode(angle);
  }
  views.frame(world.bounds());
}

function followTheme(): void {
  const light = matchMedia("(prefers-color-scheme: light)");
  const show = (): void => {
    document.documentElement.dataset["theme"] = light.matches ? "light" : "dark";
  };
  show();
  light.addEventListener("change", show);
}

function textOf(id: string): string {
  return document.getElementById(id)?.textContent ?? "";
}

const root = document.getElementById("app");
if (root !== null) {
  start(root).catch((error: unknown) => {
    const text = error instanceof Error ? error.message : String(error);
    render(<p role="alert">The recording cannot be shown: {text}</p>, root);
  });
}
