"""The names of ROS' and Gazebo's C++ interfaces that the development kit has, from its headers."""

import re
from collections.abc import Callable
from pathlib import Path

_SDK = Path(__file__).parents[2] / "sdk"
_GAZEBO = ("gazebo/include/gazebo", "sdformat/include/sdf", "ignition_math/include/ignition/math")
_OF_GAZEBO = ("gazebo", "ignition_math", "sdformat")
_CLASS = re.compile(
    r"^(?:template <[^>]*>\n)?(class|struct) (\w+)\b(?! *<)[^;{]*\{$(.*?)^\};", re.MULTILINE | re.DOTALL
)
_METHOD = re.compile(r"^  (?! |typedef |using |[A-Z_]+\()[^\n()=#]*?\b(\w+)\(", re.MULTILINE)
_FUNCTION = re.compile(r"^(?! )(?:inline |static inline )?[\w:<>,&* ]+?[ &*](\w+)\([^\n]*$", re.MULTILINE)
_MACRO = re.compile(r"^#define ([A-Z][A-Z_0-9]+)\(", re.MULTILINE)
_FIELD = re.compile(r"TRUNDLE_(?:FIELD|MESSAGE)S?\([^,]+, (\w+)\)")
_SECTION = re.compile(r"^ (public|protected|private):", re.MULTILINE)
_EVENT = re.compile(r"static ConnectionPtr (Connect\w+)")
_INNER = frozenset({"impl", "internal", "detail", "trundle_control.h"})
"""Folders and headers that users do not include."""


def gazebo_page() -> str:
    """Return the page of Gazebo: a table of classes and their functions for each folder of headers."""
    text = [
        "# Gazebo's C++ interface\n",
        "What the development kit has for [C++ plugins](../howto/cpp_plugin.md), from its headers.\n",
    ]
    for folder in _GAZEBO:
        for part in sorted({file.parent for file in (_SDK / folder).rglob("*.hh")}):
            rows = [row for file in sorted(part.glob("*.hh")) for row in _class_rows(file, _public_names)]
            if rows:
                text += [f"## {_below_include(part)}\n", _table("class", rows)]
    return "\n".join(text)


def ros_page() -> str:
    """Return the page of ROS: a table of headers, their classes and functions, for each package."""
    text = [
        "# ROS' C++ interface\n",
        "What the development kit has for [C++ nodes](../howto/cpp.md), from its headers: functions, macros, and what "
        "classes have that is public.\n",
    ]
    for package in sorted(path for path in _SDK.iterdir() if path.name not in _OF_GAZEBO):
        headers = sorted(file for file in (package / "include").rglob("*.h*") if not _INNER & {*file.parts})
        rows = [row for file in headers for row in _header_rows(file)]
        if rows:
            text += [f"## {package.name}\n", _table("header or class", rows)]
    return "\n".join(text)


def _header_rows(file: Path) -> list[str]:
    """Return a row of a header with its functions and macros, and those of its classes."""
    source = file.read_text(encoding="utf-8")
    outside = _CLASS.sub("", source)
    names = [name for name in _FUNCTION.findall(outside) if not name.startswith("TRUNDLE")]
    macros = [name for name in _MACRO.findall(source) if not name.startswith(("TRUNDLE", "_"))]
    row = f"| <{_below_include(file)}> | {_shown([*names, *macros])} |".replace("<", "`<", 1).replace(">", ">`", 1)
    return list(dict.fromkeys([row, *_class_rows(file, _members)]))


def _table(heading: str, rows: list[str]) -> str:
    return f"| {heading} | functions |\n|---|---|\n" + "\n".join(rows) + "\n"


def _below_include(path: Path) -> str:
    return path.relative_to(_SDK).as_posix().partition("/include/")[2]


def _class_rows(file: Path, names: Callable[[str, str], list[str]]) -> list[str]:
    rows: list[str] = []
    for kind, name, body in _CLASS.findall(file.read_text(encoding="utf-8")):
        if shown := _shown([method for method in names(kind, body) if method not in (name, "operator")]):
            rows.append(f"| `{name}` | {shown} |")
    return rows


def _shown(names: list[str]) -> str:
    return " ".join(f"`{name}`" for name in dict.fromkeys(names) if name[-1] != "_")


def _public_names(kind: str, body: str) -> list[str]:
    """Return the fields and functions of a class of Gazebo; its structs are the kit's own."""
    if kind == "struct":
        return []
    return _EVENT.findall(body) or [*_FIELD.findall(body), *_METHOD.findall(_public(body))]


def _members(kind: str, body: str) -> list[str]:
    """Return the functions of a class or struct of ROS."""
    return _METHOD.findall(body if kind == "struct" else _public(body))


def _public(body: str) -> str:
    """Return the public parts of a class."""
    parts = _SECTION.split(body)
    return "".join(text for section, text in zip(parts[1::2], parts[2::2], strict=True) if section == "public")
