"""Makes src/trundle/ros/message_types.pyi: a Protocol for each ROS message that an annotation in the sources names.

    python typings/message_types.py

Definitions are those that Trundle ships; what a message contains comes along. Messages are made at run time, so the
types are for annotations alone.
"""

import ast
import subprocess
import sys
from collections.abc import Iterator
from keyword import iskeyword
from pathlib import Path

from trundle.ros import Messages

ROOT = Path(__file__).parents[1]
SOURCES = ROOT / "src/trundle"
TARGET = SOURCES / "ros/message_types.pyi"
HEAD = '''"""ROS messages by package, for annotations; import under TYPE_CHECKING. Made by typings/message_types.py."""

# ruff: noqa: N801, N815
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .messages.raw_message import TypedMessage

class Time(TypedMessage, Protocol):
    """time or duration."""

    sec: int
    nanosec: int
'''
NUMBERS = {"bool": "bool", "string": "str", "float32": "float", "float64": "float"}
TIMES = {"time": "Time", "duration": "Time"}


def asked_types(file: Path) -> set[str]:
    """Types as 'geometry_msgs/Twist' that a file's annotations name."""
    text = file.read_text()
    if "message_types import" not in text:
        return set()
    packages: set[str] = set()
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").endswith("message_types"):
            packages |= {name.name for name in node.names}
    found: set[str] = set()
    for node in annotations(tree):
        for part in ast.walk(node):
            if isinstance(part, ast.Attribute) and isinstance(part.value, ast.Name) and part.value.id in packages:
                found.add(f"{part.value.id}/{part.attr}")
    return found


def annotations(tree: ast.AST) -> Iterator[ast.AST]:
    """Annotations of a file, those in quotes too."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and "." in node.value:
            try:
                yield ast.parse(node.value, mode="eval")
            except (SyntaxError, ValueError):
                continue
        elif isinstance(node, ast.Attribute):
            yield node


def python_type(ros: str) -> str:
    """Python's type of a field."""
    base, is_array, _ = ros.partition("[")
    if is_array:
        if base in ("string", *TIMES) or "/" in base:
            return f"list[{python_type(base)}]"
        number = {"char": "uint8", "byte": "int8"}.get(base, base)
        return f"NDArray[np.{number if number != 'bool' else 'bool_'}]"
    return base.replace("/", ".") if "/" in base else TIMES.get(base) or NUMBERS.get(base, "int")


def with_contained(types: set[str], messages: Messages) -> dict[str, dict[str, str]]:
    """Fields by type, of these types and of those in them."""
    known: dict[str, dict[str, str]] = {}
    waiting = sorted(types)
    while waiting:
        name = waiting.pop()
        if name not in known:
            known[name] = messages.fields(name)
            waiting += [base for field in known[name].values() if "/" in (base := field.partition("[")[0])]
    return known


def stub() -> str:
    """The whole file."""
    messages = Messages()
    types = set[str]().union(*(asked_types(file) for file in SOURCES.rglob("*.py")))
    for name in sorted(types):  # a service's request and response are known once the service is
        service = name.removesuffix("Request").removesuffix("Response")
        if service != name and not messages.has(name):
            messages.service(service)
    known = with_contained(types, messages)
    lines = [HEAD]
    for package in sorted({name.partition("/")[0] for name in known}):
        lines.append(f"class {package}:")
        for name in sorted(each for each in known if each.startswith(f"{package}/")):
            lines += [f"    class {name.partition('/')[2]}(TypedMessage, Protocol):"]
            fields = [f"{key}_" if iskeyword(key) else key for key in known[name]]
            types_of = [python_type(ros) for ros in known[name].values()]
            lines += [f"        {field}: {kind}" for field, kind in zip(fields, types_of, strict=True)]
            for constant, (kind, _) in messages.constants(name).items():
                lines.append(f"        {constant}: {python_type(kind)}")
            if not fields and not messages.constants(name):
                lines[-1] += " ..."
            lines.append("")
    text = "\n".join(lines)
    command = [sys.executable, "-m", "ruff", "format", "--stdin-filename", str(TARGET), "-"]
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True, cwd=ROOT).stdout


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        sys.exit(0 if TARGET.read_text() == stub() else f"{TARGET} is not up to date: make format")
    TARGET.write_text(stub())
