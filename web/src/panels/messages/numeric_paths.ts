/** Paths to the numbers of a type, from its definition alone. */

import type { MessageType } from "./definition";
import { isNumeric } from "./values";

const MAX_ELEMENTS = 9;
const MAX_PATHS = 200;
/** Largest number of nested messages, which may be recursive. */
const MAX_MESSAGES = 2000;

/** Paths such as `.pose.position.x`; of arrays of variable length the first element, of long ones the first nine. */
export function numericPaths(type: MessageType): readonly string[] {
  const paths: string[] = [];
  let messages = 0;
  const add = (within: MessageType, prefix: string): void => {
    messages += 1;
    if (messages > MAX_MESSAGES) return;
    for (const field of within.root.fields) {
      const count = field.isArray ? Math.min(MAX_ELEMENTS, field.length ?? 1) : 1;
      for (let index = 0; index < count && paths.length < MAX_PATHS; index += 1) {
        const path = `${prefix}.${field.name}${field.isArray ? `[${index}]` : ""}`;
        if (field.isComplex) add(within.within(field.type), path);
        else if (isNumeric(field.type) || field.type === "bool") paths.push(path);
      }
    }
  };
  add(type, "");
  return paths;
}
