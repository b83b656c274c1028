/** Entries of an object's menu, in the order of Gazebo's right-click menu. */

import { Vector3 } from "three";

import type { MenuItem } from "../../theme/menu_list";
import { toggleFirstPerson } from "../views/first_person";
import { isFollowing, targetOf, toggleFollowing } from "../views/following";
import { frameSelection } from "../views/framing";
import { copyModel, deleteLight, deleteModel, holdModel, resetModel } from "../world/model_edits";
import type { Selection } from "../../page/page";
import type { Shell } from "../shell";
import { PART_NAMES, partsOf, toggleHidden } from "../views/shown_parts";
import { canEdit } from "../world/edits";
import { openWrench } from "./open_wrench";
import { findModel, placed } from "../../page/selection_lookup";

type InModel = Extract<Selection, { kind: "model" | "link" }>;

/** Menu entries for a selection; `at`: point of the world where the menu was opened [m]. */
export function objectItems(shell: Shell, selected: Selection | null, at: Vector3 | null): readonly MenuItem[] {
  const selection = placed(selected);
  const inModel = selection?.kind === "model" || selection?.kind === "link" ? selection : null;
  const items = [
    ...(selection === null ? [] : viewItems(shell, selection)),
    ...(inModel === null || !shell.isDrawn.value ? [] : shownItems(shell, inModel)),
    ...(canEdit(shell) ? editItems(shell, selection, inModel, at) : []),
  ];
  return items.some(({ disabled }) => disabled !== true) ? items : [];
}

function viewItems({ page, isDrawn }: Shell, selection: Selection): MenuItem[] {
  if (!isDrawn.value || targetOf(page, selection) === null) return [];
  return [
    { title: "Move to", keys: "F", run: () => frameSelection(page, selection) },
    { title: isFollowing(page) ? "Stop following" : "Follow", keys: "Shift F", run: () => toggleFollowing(page) },
    { title: "First person", run: () => toggleFirstPerson(page) },
  ];
}

function shownItems({ page }: Shell, selection: InModel): MenuItem[] {
  const { world } = page;
  const { model } = selection;
  const name = selection.kind === "model" ? model : `${model}::${selection.link}`;
  const parts = (): MenuItem[] =>
    partsOf(page).map((part) => {
      const isShown = world.shown.of(part, model);
      return {
        title: PART_NAMES[part],
        checked: isShown,
        stays: true,
        run: () => world.shown.set(part, model, !isShown),
      };
    });
  return [
    { title: "View", starts: true, items: parts },
    { title: world.hidden.value.has(name) ? "Show again" : "Hide", run: () => toggleHidden(page, name) },
  ];
}

function editItems(shell: Shell, selection: Selection | null, inModel: InModel | null, at: Vector3 | null): MenuItem[] {
  if (selection?.kind === "light")
    return [{ title: "Delete", keys: "Delete", run: () => deleteLight(shell, selection.light) }];
  const copied = shell.copied.value;
  const paste: MenuItem = {
    title: "Paste",
    disabled: copied === null || findModel(shell.page, copied) === null,
    ...(copied === null ? {} : { detail: copied }),
    run: () => copied !== null && copyModel(shell, copied, at),
  };
  if (inModel === null) return [paste];
  return [
    ...handlingItems(shell, inModel),
    { title: "Copy", starts: true, run: () => (shell.copied.value = inModel.model) },
    paste,
    deleteItem(shell, inModel),
  ];
}

function handlingItems(shell: Shell, selection: InModel): MenuItem[] {
  const { model } = selection;
  const info = findModel(shell.page, model);
  const edit: MenuItem = { title: "Edit model…", starts: true, run: () => void shell.editor.begin(model) };
  if (info === null || info.static) return [edit];
  return [
    edit,
    { title: "Apply force or torque…", run: () => openWrench(shell, selection) },
    { title: info.held ? "Release" : "Hold in the air", keys: "H", run: () => holdModel(shell, model, !info.held) },
    { title: "Reset this model", run: () => resetModel(shell, model) },
  ];
}

function deleteItem(shell: Shell, { model }: InModel): MenuItem {
  return { title: "Delete", keys: "Delete", run: () => deleteModel(shell, model) };
}
