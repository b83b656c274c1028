"""Finding the models in an upload: folders with a model.config."""

from pathlib import Path
from xml.sax.saxutils import escape

from trundle.base.diagnostics import UsageError

_CONFIG = "model.config"
_SUFFIXES = (".sdf", ".urdf")


def find_models(root: Path, title: str) -> dict[str, Path]:
    """Return the folder of each model by name.

    Without any model.config, one is written for the only .sdf or .urdf.

    Args:
        root: folder of the uploaded files.
        title: name of a model whose files are directly in `root`.

    Raises:
        UsageError: there is no model, or several files could be the model.
    """
    folders: dict[str, Path] = {}
    for config in sorted(root.rglob(_CONFIG), key=lambda path: len(path.parts)):
        folder = config.parent
        if not any(folder.is_relative_to(other) for other in folders.values()):
            folders.setdefault(title if folder == root else folder.name, folder)
    if folders:
        return folders
    entries = list(root.iterdir())
    folder = entries[0] if len(entries) == 1 and entries[0].is_dir() else root
    name = title if folder == root else folder.name
    _write_config(folder, name)
    return {name: folder}


def _write_config(folder: Path, name: str) -> None:
    files = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.suffix in _SUFFIXES)
    if not files:
        raise UsageError("no model.config, .sdf or .urdf in it")
    if len(files) > 1:
        raise UsageError(f"several files may be the model: {', '.join(files[:5])}; add a model.config that names one")
    text = f"<model><name>{escape(name)}</name><sdf version='1.6'>{escape(files[0])}</sdf></model>\n"
    (folder / _CONFIG).write_text(text, encoding="utf-8")
