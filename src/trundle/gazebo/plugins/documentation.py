"""Documentation of the built-in plugins, from their docstrings: what each does, and its parameters."""

import ast
import re
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from msgspec import Struct

from .catalog import BUILTIN, SENSOR_PLUGINS

_VALUE = r"[−-]?\d[\d.e/−-]*(?: [−-]?\d[\d.]*)*|[\w/]+"
_PARAMETER = re.compile(rf"(?<![/\w])<(\w+)>(?:\s+\(({_VALUE})\)|\s+({_VALUE})(?=[,;)]|\.(?:\s|$)|\s[\[(]))?")
"""Element with its default: "<topic> scan," or "<topic> (scan)"."""
_WORDS = frozenset({"required", "none", "and", "or"})


class PluginParameter(Struct, frozen=True):
    """Element of a plugin's tag."""

    name: str
    default: str
    """As documented; empty: none is."""


class PluginDocumentation(Struct, frozen=True):
    """Docstring of a plugin, taken apart."""

    about: str
    """First sentence."""
    parameters: tuple[PluginParameter, ...]


@cache
def plugin_documentation(filename: str) -> PluginDocumentation | None:
    """Return the documentation of a built-in plugin by its file name; None: it is not built in, or not documented."""
    target = BUILTIN.get(filename) or SENSOR_PLUGINS.get(filename)
    text = None if target is None else _docstring(*target.split(":"))
    if text is None:
        return None
    first = " ".join(text.split("\n\n")[0].split())
    about = re.sub(r"<(\w+)>", r"\1", first.split(". ")[0].rstrip("."))
    found: dict[str, str] = {}
    for match in _PARAMETER.finditer(text):
        default = (match[2] or match[3] or "").replace("−", "-")
        found.setdefault(match[1], "" if default in _WORDS else default)
    return PluginDocumentation(about, tuple(PluginParameter(name, default) for name, default in found.items()))


def _docstring(module: str, name: str) -> str | None:
    """Return the docstring of a class or function of a module, else the module's."""
    spec = find_spec(module)
    if spec is None or spec.origin is None:
        return None
    tree = ast.parse(Path(spec.origin).read_text(encoding="utf-8"))
    named = (each for each in tree.body if isinstance(each, ast.ClassDef | ast.FunctionDef) and each.name == name)
    found = next(named, None)
    return (None if found is None else ast.get_docstring(found)) or ast.get_docstring(tree)
