"""Saving a draft as a folder with model.sdf and model.config, below the folder where the simulation was started.

Uploaded models that the draft needs are copied next to that folder.
"""

from pathlib import Path

from trundle.base.output_folder import find_target, save_files
from trundle.page import SaveDraft
from trundle.robots.description import move_uris
from trundle.robots.packages import Packages

from ..model_editor.draft import Draft
from ..model_editor.model_files import model_config, target_files
from ..requests.answers import FilesExist, SavedFile
from .uploaded_files import copies, needed_uploads, with_upload_uris


def save_draft(draft: Draft, request: SaveDraft, root: Path, packages: Packages) -> SavedFile | FilesExist:
    """Write a draft's files.

    Raises:
        UsageError: the folder is outside `root`, or the files cannot be written.
    """
    folder = find_target(root, request.folder, example="models/cart")
    text = with_upload_uris(move_uris(draft.text, old_folder=root, new_folder=folder, packages=packages), packages)
    written = dict(zip(target_files(folder), (text, model_config(text, draft.name)), strict=True))
    files = {**copies(needed_uploads(text, packages), folder.parent), **written}
    exists = save_files(root, files, replace=request.replace)
    return SavedFile(file=request.folder) if exists is None else FilesExist(exists=exists)
