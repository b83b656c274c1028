"""Saving of a draft as a folder with model.sdf and model.config, below the folder where the simulation was started."""

from pathlib import Path

from trundle.description import move_uris
from trundle.diagnostics import UsageError
from trundle.packages import Packages
from trundle.page import SaveDraft

from ..model_editor.draft import Draft
from ..model_editor.model_files import model_config, target_files
from .world_saver import check_inside, is_file_name, write_file


def save_draft(draft: Draft, request: SaveDraft, root: Path, packages: Packages) -> dict[str, object]:
    """Write a draft; return `folder`, or `exists` where a file is in the way that may not be replaced.

    Raises:
        UsageError: the name leads elsewhere, or the files cannot be written.
    """
    folder = _target(root, request.folder)
    files = target_files(folder)
    if not request.replace and any(file.exists() for file in files):
        return {"exists": request.folder}
    text = move_uris(draft.text, here=root, there=folder, packages=packages)
    for file, content in zip(files, (text, model_config(text, draft.name)), strict=True):
        if not write_file(root, file, content, replace=request.replace):
            return {"exists": request.folder}
    return {"folder": request.folder}


def _target(root: Path, name: str) -> Path:
    parts = name.split("/")
    if not all(map(is_file_name, parts)):
        raise UsageError(
            f"{name!r}: a model is saved below the folder where Trundle was started; write a name such as "
            "models/cart, of letters, digits, blanks and . _ + -"
        )
    folder = root.joinpath(*parts)
    for file in target_files(folder):
        check_inside(root, file)
    return folder
