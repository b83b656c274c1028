"""Reference of diagnostics: every message about a file, collected from the reporting calls."""

import ast
from collections.abc import Iterator, Mapping
from pathlib import Path

import trundle

from .markdown import cell

_SOURCE = Path(trundle.__file__).parent
_SEVERITY = {"warn": "warning", "info": "info", "DescriptionError": "error"}
_ROOMS = (
    *("base/xmlnode", "robots/description", "robots/robot", "robots/launch", "robots/lint"),
    *("sim/physics", "sim/sensors", "gazebo/plugins", "gazebo/nodes"),
)
_INTRO = """# Diagnostics

A diagnostic names the location, the problem, and its consequence:

```text
cart.sdf:42: warning: <cast_shadow> in <light> is not supported; it is ignored
```

- An **error** means that the file cannot be used. The command exits with 1.
- A **warning** names something invalid or not supported; reading continues as stated. `--strict` makes every
  warning an error.
- An **info** states a rule that may be unexpected. `trundle check` prints it; `trundle run` does not.

`trundle check FILE` lists all diagnostics, errors first; `trundle check FILE --json` prints them as
`{"severity", "file", "line", "message"}`. From Python they are in `sim.report.findings`.

Below are all messages by source file; `…` replaces the variable parts.
"""


def page() -> str:
    """Return every message, by folder and file."""
    parts = [_INTRO]
    for room in _ROOMS:
        tables = [table for path in sorted((_SOURCE / room).rglob("*.py")) if (table := _table(path))]
        if tables:
            parts += [f"## {room}\n", *tables]
    return "\n".join(parts)


def _table(path: Path) -> str:
    rows = sorted({(line, severity, text) for line, severity, text in _sentences(ast.parse(path.read_text()))})
    if not rows:
        return ""
    head = f"`{path.relative_to(_SOURCE)}`\n\n| | |\n|---|---|\n"
    return head + "".join(f"| {severity} | {cell(text)} |\n" for _, severity, text in rows)


def _sentences(tree: ast.AST) -> Iterator[tuple[int, str, str]]:
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            assigned = _assigned(function)
            for call in ast.walk(function):
                if isinstance(call, ast.Call) and len(call.args) >= 2:
                    name = getattr(call.func, "attr", getattr(call.func, "id", ""))
                    message = call.args[1]
                    values = assigned.get(message.id, []) if isinstance(message, ast.Name) else [message]
                    texts = [_text(value, assigned) for value in values if name in _SEVERITY]
                    yield from ((call.lineno, _SEVERITY[name], text) for text in texts if _is_specific(text))


def _assigned(function: ast.AST) -> dict[str, list[ast.expr]]:
    """Return the values assigned to each name of a function."""
    values: dict[str, list[ast.expr]] = {}
    for node in ast.walk(function):
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            values.setdefault(node.targets[0].id, []).append(node.value)
    return values


def _is_specific(text: str) -> bool:
    return len(text.strip("…")) > 1 and not text.startswith("…;")


def _text(node: ast.expr, assigned: Mapping[str, list[ast.expr]]) -> str:
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.JoinedStr):
        return "".join(_text(value, assigned) for value in node.values)
    if isinstance(node, ast.FormattedValue) and isinstance(node.value, ast.Name):
        before = [value for value in assigned.get(node.value.id, []) if value.lineno < node.lineno]
        return _text(before[-1], {}) if before else "…"
    return "…"
