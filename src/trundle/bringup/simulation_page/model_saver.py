"""Saving of a draft as a folder with model.sdf and model.config, below the folder where the simulation was started."""

from pathlib import Path

from trundle.description import move_uris
from trundle.output_folder import find_target, save_files
from trundle.packages import Packages
from trundle.page import SaveDraft

from ..model_editor.draft import Draft
from ..model_editor.model_files import model_config, target_files


def save_draft(draft: Draft, request: SaveDraft, root: Path, packages: Packages) -> dict[str, object]:
    """Write a draft; return its folder as `file`, or as `exists` where files are in the way.

    Raises:
        UsageError: the name leads elsewhere, or the files cannot be written.
    """
    folder = find_target(root, request.folder, example="models/cart")
    text = move_uris(draft.text, here=root, there=folder, packages=packages)
    files = dict(zip(target_files(folder), (text, model_config(text, draft.name)), strict=True))
    return {"file" if save_files(root, files, replace=request.replace) else "exists": request.folder}
