"""Python modules that a package's setup.py lists for catkin, by parsing the file, not running it."""

import ast
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from trundle.base.files import read_text

_MAX_BYTES = 1_000_000
_KEYWORDS = ("packages", "package_dir", "py_modules")


def read_setup(setup: Path) -> Iterator[tuple[str, Path]]:
    """Yield top-level modules of a setup.py with their paths; nothing if it cannot be read."""
    try:
        tree = ast.parse(read_text(setup, max_bytes=_MAX_BYTES))
    except (OSError, SyntaxError, ValueError, RecursionError, MemoryError):
        return
    arguments = _keywords(tree)
    folders: dict[str, str] = arguments.get("package_dir") or {}
    for name in dict.fromkeys(str(name).partition(".")[0] for name in arguments.get("packages") or ()):
        path = setup.parent / folders.get(name, os.path.join(folders.get("", ""), name))
        if os.path.isdir(path):
            yield name, path
    for name in arguments.get("py_modules") or ():
        path = setup.parent / folders.get("", "") / f"{str(name).replace('.', '/')}.py"
        if os.path.isfile(path):
            yield str(name), path


def _keywords(tree: ast.AST) -> dict[str, Any]:
    """Literal values of setup's keywords, in any call, and in `d['packages'] = …`."""
    values: dict[str, Any] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            pairs = [(keyword.arg, keyword.value) for keyword in node.keywords]
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Subscript):
            index = node.targets[0].slice
            pairs = [(index.value if isinstance(index, ast.Constant) else None, node.value)]
        else:
            continue
        for name, value in pairs:
            if name in _KEYWORDS:
                try:
                    values[str(name)] = ast.literal_eval(value)
                except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError):
                    continue
    return {name: value for name, value in values.items() if isinstance(value, dict if name == "package_dir" else list)}
