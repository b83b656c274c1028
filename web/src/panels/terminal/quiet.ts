/** Escape sequences that a terminal ignores, to protect the page and the person who types there. */

import type { IFunctionIdentifier, Terminal } from "@xterm/xterm";

/**
 * Queries that a terminal answers as if somebody typed: each page would answer, also when the output is shown again,
 * and a text that a program merely prints could type into the program. `CSI t`, xterm's window reports, is one of them.
 */
const QUESTIONS: readonly IFunctionIdentifier[] = [
  { final: "c" },
  { prefix: ">", final: "c" },
  { prefix: "=", final: "c" },
  { final: "n" },
  { prefix: "?", final: "n" },
  { intermediates: "$", final: "p" },
  { prefix: "?", intermediates: "$", final: "p" },
  { final: "t" },
];
const STATUS_STRING: IFunctionIdentifier = { intermediates: "$", final: "q" };
const FOCUS_REPORTS = 1004;
/** Titles, colors of the theme, links and the clipboard. */
const SYSTEM_COMMANDS = [0, 1, 2, 4, 8, 10, 11, 12, 52, 104, 110, 111, 112];

export function silence({ parser }: Pick<Terminal, "parser">): void {
  const swallow = (): boolean => true;
  for (const question of QUESTIONS) parser.registerCsiHandler(question, swallow);
  parser.registerCsiHandler({ prefix: "?", final: "h" }, (params) => params.includes(FOCUS_REPORTS));
  parser.registerDcsHandler(STATUS_STRING, swallow);
  for (const command of SYSTEM_COMMANDS) parser.registerOscHandler(command, swallow);
}
