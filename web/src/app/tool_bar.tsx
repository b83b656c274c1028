/** The tool bar: icons in a simulation, rviz's names in a ROS graph. */

import type { JSX } from "preact";

import { Button } from "../theme/button";
import { isIcon } from "../theme/icons";
import type { Tool } from "../page/tool";
import { canControl } from "../page/looking";
import type { Command } from "../page/page";
import type { Shell } from "./shell";

/** rviz's names, shortened where the icon says the rest. */
const SHORT: Readonly<Record<string, string>> = { "Move Camera": "Move camera", "Focus Camera": "Focus" };

/** Tools without a hint: their use is what a person tries first. */
const MOVES_THE_VIEW = ["rviz/Interact", "rviz/MoveCamera"];

export function ToolBar({ shell }: { readonly shell: Shell }): JSX.Element {
  const { tools, session } = shell.page;
  const current = tools.current.value;
  const named = session.kind !== "simulation" && shell.layout.width.value >= 1100;
  const hint = MOVES_THE_VIEW.includes(current.className) ? "" : current.hint.value;
  return (
    <>
      <div class="tools float" role="toolbar" aria-label="Tools">
        {offeredTools(shell).map((tool) => {
          const name = SHORT[tool.name] ?? tool.name;
          const icon = isIcon(tool.icon) ? tool.icon : "select";
          const common = {
            icon,
            label: name,
            keys: keyOf(shell, tool.shortcut),
            on: tool === current,
            onClick: () => tools.use(tool.className),
          };
          return named ? (
            <Button key={tool.className} {...common}>
              {name}
            </Button>
          ) : (
            <Button key={tool.className} {...common} />
          );
        })}
      </div>
      {hint !== "" && (
        <div class="notice float" role="status">
          <span class="said">{hint}</span>
        </div>
      )}
    </>
  );
}

function offeredTools({ page }: Shell): readonly Tool[] {
  return page.tools.tools.filter(({ acts }) => !acts || canControl(page));
}

/** rviz's key, with Shift if the key drives the robot. */
function keyOf(shell: Shell, shortcut: string): string {
  const letter = shortcut.toUpperCase();
  return shell.page.drive.topic.value !== null && "WASD".includes(letter) ? `Shift ${letter}` : letter;
}

export function toolCommands(shell: Shell): readonly Command[] {
  return offeredTools(shell)
    .filter((tool) => tool.shortcut !== "")
    .flatMap((tool) => {
      const letter = tool.shortcut.toUpperCase();
      const command: Command = {
        id: `tool.${tool.className}`,
        group: "Tools",
        title: tool.name,
        keys: letter,
        run: () => shell.page.tools.use(tool.className),
      };
      const isDriving = (): boolean => shell.page.drive.topic.peek() !== null;
      const shifted: Command = { ...command, id: `${command.id}.shift`, keys: `Shift ${letter}`, enabled: isDriving };
      return "WASD".includes(letter) ? [shifted, { ...command, enabled: () => !isDriving() }] : [command];
    });
}
