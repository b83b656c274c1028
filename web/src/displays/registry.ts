/** Displays by rviz's class names. */

import type { Display, DisplayContext } from "./display";

export interface DisplayClass {
  /** Class name, as `rviz/LaserScan`. */
  readonly className: string;
  /** Other names of the same class, as ROS 2's. */
  readonly aliases: readonly string[];
  /** Message types that it shows; empty: none. */
  readonly types: readonly string[];
  readonly create: (context: DisplayContext) => Display;
}

const classes = new Map<string, DisplayClass>();

/** Register a class; each display's file calls this once. ROS 2's name is added by itself. */
export function register(display: DisplayClass): void {
  const [, short = ""] = display.className.split("/");
  for (const name of [display.className, `rviz_default_plugins/${short}`, ...display.aliases])
    classes.set(name, display);
}

export function displayClass(name: string): DisplayClass | undefined {
  return classes.get(name);
}

/** Every class once, in the order they were registered. */
export function displayClasses(): readonly DisplayClass[] {
  return [...new Set(classes.values())];
}
