/** Menu of actions on the whole world, above its tree. */

import type { JSX } from "preact";

import { MenuButton } from "../../theme/menu";
import type { MenuItem } from "../../theme/menu_list";
import type { Shell } from "../shell";

const COMMANDS = ["side.insert", "new_model", "save_world", "reload", "compare", "compare.stop"];
/** Commands that start a group below the first. */
const STARTS = ["save_world", "compare"];

export function WorldMenu({ shell }: { readonly shell: Shell }): JSX.Element {
  const items = (): readonly MenuItem[] =>
    COMMANDS.flatMap((id) => shell.commands.all.peek().filter((command) => command.id === id)).map(
      ({ id, title, keys, run, enabled }) => ({
        title,
        starts: STARTS.includes(id),
        keys,
        disabled: enabled?.() === false,
        run,
      }),
    );
  return <MenuButton icon="dots" label="World's menu" items={items} />;
}
