/** The tool bar: six icons and a menu in a simulation, rviz's tools by name in a ROS graph. */

import type { JSX, RefObject } from "preact";
import { useRef } from "preact/hooks";

import { Button } from "../theme/button";
import { FittingPart, useFittingRow } from "../theme/fitting_row";
import { isIcon, type IconName } from "../theme/icons";
import { MenuButton } from "../theme/menu";
import type { MenuItem } from "../theme/menu_list";
import type { Tool } from "../page/tool";
import { isWatcher } from "../protocol/watchers";
import { canControl } from "../page/view_only";
import type { Command } from "../page/page";
import type { Shell } from "./shell";

/** rviz's names, shortened where the icon tells the rest. */
const SHORT: Readonly<Record<string, string>> = { "Move Camera": "Move camera", "Focus Camera": "Focus" };
/** Tools in the bar of a simulation; others are in its menu. */
const OF_SIMULATION = [
  "rviz/Interact",
  "trundle/Move",
  "trundle/Rotate",
  "trundle/Push",
  "rviz/Measure",
  "trundle/Insert",
];

export function ToolBar({ shell }: { readonly shell: Shell }): JSX.Element {
  const { page } = shell;
  const row = useRef<HTMLDivElement>(null);
  useFittingRow(row);
  const current = page.tools.current.value;
  const simulates = page.session.kind === "simulation";
  const useful = offeredTools(shell).filter((tool) => isHeard(shell, tool) || tool === current);
  const shown = simulates ? useful.filter(({ className }) => OF_SIMULATION.includes(className)) : useful;
  return (
    <div ref={row} class="tools float" role="toolbar" aria-label="Tools">
      {shown.map((tool, index) => (
        <FittingPart key={tool.className} rank={shown.length - index + 1} part={tool.className}>
          <ToolButton shell={shell} tool={tool} isNamed={!simulates} />
        </FittingPart>
      ))}
      <MoreTools shell={shell} row={row} others={useful.filter((tool) => !shown.includes(tool))} current={current} />
    </div>
  );
}

interface ToolButtonProps {
  readonly shell: Shell;
  readonly tool: Tool;
  readonly isNamed: boolean;
}

function ToolButton({ shell, tool, isNamed }: ToolButtonProps): JSX.Element {
  const { tools } = shell.page;
  const name = nameOf(tool);
  const common = {
    icon: iconOf(tool),
    label: name,
    keys: keyOf(shell, tool.shortcut),
    on: tool === tools.current.value,
    onClick: () => tools.use(tool.className),
  };
  return isNamed ? (
    <Button {...common}>
      <FittingPart rank={1}>{name}</FittingPart>
    </Button>
  ) : (
    <Button {...common} />
  );
}

interface MoreToolsProps {
  readonly shell: Shell;
  readonly row: RefObject<HTMLElement | null>;
  /** Tools that are never in the bar. */
  readonly others: readonly Tool[];
  readonly current: Tool;
}

/** Menu of the tools that are not in the bar; it has the icon of the one that is on. */
function MoreTools({ shell, row, others, current }: MoreToolsProps): JSX.Element {
  const isGiven = ({ className }: Tool): boolean =>
    row.current?.querySelector(`[data-given][data-part="${className}"]`) !== null;
  const items = (): readonly MenuItem[] =>
    offeredTools(shell)
      .filter((tool) => others.includes(tool) || isGiven(tool))
      .map((tool) => ({
        title: nameOf(tool),
        icon: iconOf(tool),
        keys: keyOf(shell, tool.shortcut),
        checked: tool === current,
        run: () => shell.page.tools.use(tool.className),
      }));
  const isOn = others.includes(current);
  return (
    <MenuButton
      class={`${others.length > 0 ? "" : "more"} ${isOn ? "on" : ""}`}
      icon={isOn ? iconOf(current) : "dots"}
      label={isOn ? `More tools, now ${nameOf(current)}` : "More tools"}
      items={items}
    />
  );
}

/** True if a node other than the page's subscribes to the topic on which a tool publishes for navigation. */
function isHeard({ page }: Shell, { navigates }: Tool): boolean {
  if (navigates.value === null) return true;
  const nodes = page.connection.graph.value.subscribers.get(navigates.value) ?? [];
  return nodes.some((node) => node !== page.session.node && !isWatcher(node));
}

function nameOf({ name }: Tool): string {
  return SHORT[name] ?? name;
}

function iconOf({ icon }: Tool): IconName {
  return isIcon(icon) ? icon : "select";
}

/** Tools without a hint: a person tries their gestures first anyway. */
const MOVES_THE_VIEW = ["rviz/Interact", "rviz/MoveCamera"];

/**
 * Line with the action that the current tool waits for, placed last so that nothing moves when it appears; null: none.
 */
export function ToolHint({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const { current } = shell.page.tools;
  const { className, hint } = current.value;
  if (hint.value === "" || MOVES_THE_VIEW.includes(className)) return null;
  return (
    <div class="notice float" role="status">
      <span class="said">{hint.value}</span>
    </div>
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
