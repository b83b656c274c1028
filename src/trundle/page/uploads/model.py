"""Models in the files of an upload: their folders, each with a model.config."""

from pathlib import Path
from xml.sax.saxutils import escape

from trundle.base.diagnostics import UsageError

_CONFIG = "model.config"
_SUFFIXES = (".sdf", ".urdf")


def find_models(root: Path, title: str) -> dict[str, Path]:
    """Return the folder of each model by name.

    Where no folder has a model.config, the only .sdf or .urdf is the model's file, and gets one.

    Args:
        root: folder of the files.
        title: name of a model whose files are not in a folder of their own.

    Raises:
        UsageError: there is no model, or it is not said which file is the model's.
    """
    found: dict[str, Path] = {}
    for config in sorted(root.rglob(_CONFIG), key=lambda path: len(path.parts)):
        folder = config.parent
        if not any(folder.is_relative_to(other) for other in found.values()):
            found.setdefault(title if folder == root else folder.name, folder)
    if found:
        return found
    inside = list(root.iterdir())
    folder = inside[0] if len(inside) == 1 and inside[0].is_dir() else root
    name = title if folder == root else folder.name
    _write_config(folder, name)
    return {name: folder}


def _write_config(folder: Path, name: str) -> None:
    files = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.suffix in _SUFFIXES)
    if not files:
        raise UsageError("no model.config, .sdf or .urdf in it")
    if len(files) > 1:
        raise UsageError(f"a model.config is to say which file is the model: {', '.join(files[:5])}")
    text = f"<model><name>{escape(name)}</name><sdf version='1.6'>{escape(files[0])}</sdf></model>\n"
    (folder / _CONFIG).write_text(text, encoding="utf-8")
