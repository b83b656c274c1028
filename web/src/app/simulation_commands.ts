/** Commands of the simulation's clock. */

import { canControl } from "../page/view_only";
import type { Command, Page } from "../page/page";
import { saveReplay } from "./dialogs/save_replay";
import type { Shell } from "./shell";

/** True where there is a clock to control: a simulation, a recorded run, a bag. */
export function simulates(page: Page): boolean {
  return page.session.kind !== "graph";
}

export function simulationCommands(shell: Shell): readonly Command[] {
  const { page } = shell;
  if (!simulates(page)) return [];
  const command = (id: string, title: string, act: () => void, keys?: string): Command => ({
    id,
    title,
    group: "Simulation",
    ...(keys === undefined ? {} : { keys }),
    enabled: () => page.connection.state.peek().kind === "connected" && canControl(page),
    run: act,
  });
  const clock = [
    command("play_pause", "Play or pause", () => toggle(shell), "Space"),
    ...[0.1, 0.5, 1, 2].map((factor) =>
      command(`speed.${factor}`, `Speed ${factor}×`, () => shell.request("Speed", "speed", { factor })),
    ),
    command("time", "Go to a time, or take several steps…", () => void (shell.dialog.value = "time")),
    command("speed.max", "As fast as possible", () => shell.request("Speed", "speed", { factor: null })),
  ];
  if (page.session.kind !== "simulation") return clock;
  return [
    ...clock,
    command("step", "Step 1", () => shell.request("Step 1", "step", { count: 1 }), "."),
    command("reset.all", "Reset time and poses", () => shell.request("Reset", "reset", { what: "all" }), "Shift R"),
    command("reset.poses", "Reset poses only", () => shell.request("Reset", "reset", { what: "poses" })),
    command("reset.time", "Reset time only", () => shell.request("Reset", "reset", { what: "time" })),
    command("replay", "Save a replay of the last minutes", () => void saveReplay(shell, "html")),
    command("replay.glb", "Save the last minutes as glTF", () => void saveReplay(shell, "glb")),
    command("reload", "Load the world again", () => shell.request("Load the world again", "reload", {})),
  ];
}

function toggle(shell: Shell): void {
  const paused = shell.page.world.state.peek()?.paused ?? true;
  shell.request(paused ? "Play" : "Pause", paused ? "play" : "pause", {});
}
