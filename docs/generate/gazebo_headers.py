"""The names of Gazebo's interface that the development kit has, from its headers."""

import re
from pathlib import Path

_SDK = Path(__file__).parents[2] / "sdk"
_FOLDERS = ("gazebo/include/gazebo", "sdformat/include/sdf", "ignition_math/include/ignition/math")
_CLASS = re.compile(r"^(?:template <[^>]*>\n)?class (\w+)[^;{]*\{$(.*?)^\};", re.MULTILINE | re.DOTALL)
_METHOD = re.compile(r"^  (?! )[^\n()=#]*?\b(\w+)\(", re.MULTILINE)
_FIELD = re.compile(r"TRUNDLE_(?:FIELD|MESSAGE)S?\([^,]+, (\w+)\)")
_SECTION = re.compile(r"^ (public|protected|private):", re.MULTILINE)
_EVENT = re.compile(r"static ConnectionPtr (Connect\w+)")


def page() -> str:
    """Return the page: a table of classes and their functions for each folder of headers."""
    text = [
        "# Gazebo's C++ interface\n",
        "What the development kit has for [C++ plugins](../howto/cpp_plugin.md), from its headers.\n",
    ]
    for folder in _FOLDERS:
        for part in sorted({file.parent for file in (_SDK / folder).rglob("*.hh")}):
            rows = [row for file in sorted(part.glob("*.hh")) for row in _rows(file)]
            if rows:
                name = part.relative_to(_SDK).as_posix().partition("/include/")[2]
                text += [f"## {name}\n", "| class | functions |\n|---|---|\n" + "\n".join(rows) + "\n"]
    return "\n".join(text)


def _rows(file: Path) -> list[str]:
    rows: list[str] = []
    for name, body in _CLASS.findall(file.read_text(encoding="utf-8")):
        names = _EVENT.findall(body) or [*_FIELD.findall(body), *_METHOD.findall(_public(body))]
        shown = [
            f"`{method}`" for method in dict.fromkeys(names) if method not in (name, "operator") and method[-1] != "_"
        ]
        if shown:
            rows.append(f"| `{name}` | {' '.join(shown)} |")
    return rows


def _public(body: str) -> str:
    """Return the public parts of a class."""
    parts = _SECTION.split(body)
    return "".join(text for section, text in zip(parts[1::2], parts[2::2], strict=True) if section == "public")
