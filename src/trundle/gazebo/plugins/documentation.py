"""Documentation of the built-in plugins, from their docstrings: the first sentence, and the parameters."""

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
_NOT_DEFAULTS = frozenset({"required", "none", "and", "or"})


class PluginParameter(Struct, frozen=True):
    """Element of a plugin's tag."""

    name: str
    default: str
    """Default as documented; empty: none."""


class PluginDocumentation(Struct, frozen=True):
    """Parsed docstring of a plugin."""

    about: str
    """First sentence."""
    parameters: tuple[PluginParameter, ...]


@cache
def plugin_documentation(filename: str) -> PluginDocumentation | None:
    """Return the documentation of a built-in plugin by its file name; None: not built in, or not documented."""
    target = BUILTIN.get(filename) or SENSOR_PLUGINS.get(filename)
    text = None if target is None else _docstring(*target.split(":"))
    if text is None:
        return None
    first = " ".join(text.split("\n\n")[0].split())
    about = re.sub(r"<(\w+)>", r"\1", first.split(". ")[0].rstrip("."))
    defaults: dict[str, str] = {}
    for match in _PARAMETER.finditer(text):
        default = (match[2] or match[3] or "").replace("−", "-")
        defaults.setdefault(match[1], "" if default in _NOT_DEFAULTS else default)
    return PluginDocumentation(about, tuple(PluginParameter(name, default) for name, default in defaults.items()))


def _docstring(module: str, name: str) -> str | None:
    """Return the docstring of a class or function of a module; without one, the module's."""
    spec = find_spec(module)
    if spec is None or spec.origin is None:
        return None
    tree = ast.parse(Path(spec.origin).read_text(encoding="utf-8"))
    definitions = (
        definition
        for definition in tree.body
        if isinstance(definition, ast.ClassDef | ast.FunctionDef) and definition.name == name
    )
    definition = next(definitions, None)
    return (None if definition is None else ast.get_docstring(definition)) or ast.get_docstring(tree)
