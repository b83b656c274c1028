/** Entries of a pane's menu: its possible views. */

import type { ViewPane } from "../../scene/view_controller";
import type { MenuItem } from "../../theme/menu_list";
import { lookThrough, toggleFirstPerson } from "../views/first_person";
import { isFollowing, toggleFollowing } from "../views/following";
import { frameSelection } from "../views/framing";
import type { Shell } from "../shell";
import { chooseSplit } from "./remembered_split";

const SIDES = ["top", "front", "right", "bottom", "back", "left"] as const;

export function paneItems(shell: Shell, pane: ViewPane): readonly MenuItem[] {
  const { page } = shell;
  const { views } = page;
  const here = (act: () => void) => (): void => {
    views.activate(pane);
    act();
  };
  const isActive = views.active.value === pane;
  return [
    ...SIDES.map(
      (side): MenuItem => ({
        title: `Look from ${/top|bottom/.test(side) ? side : `the ${side}`}`,
        run: here(() => views.lookFrom(side)),
      }),
    ),
    { title: "Perspective or orthographic", starts: true, run: here(() => views.toggleProjection()) },
    { title: "First person", run: here(() => toggleFirstPerson(page)) },
    { title: isActive && isFollowing(page) ? "Stop following" : "Follow", run: here(() => toggleFollowing(page)) },
    { title: "Frame", run: here(() => frameSelection(page, page.selection.peek())) },
    ...(page.world.manifest.value?.cameras ?? []).map(
      (camera, index): MenuItem => ({
        title: `Through ${camera.name}`,
        icon: "camera",
        starts: index === 0,
        run: here(() => lookThrough(page, camera)),
      }),
    ),
    { title: "Only this one", starts: true, run: here(() => chooseSplit(shell.split, "one")) },
  ];
}
