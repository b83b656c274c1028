"""Reference of diagnostics: the registry of IDs, each with its messages, collected from the reporting calls."""

import ast
import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import trundle
from trundle.base.explanations import pages

from .markdown import cell

_SOURCE = Path(trundle.__file__).parent
_SEVERITY = {"warn": "warning", "info": "info", "DescriptionError": "error", "UnknownArgumentError": "error"}
_WINGS = ("base", "robots", "sim", "gazebo", "live", "app")
_HEADING = re.compile(r"^## (.+)$", re.MULTILINE)
_INTRO = """# Diagnostics

A diagnostic names the location, the problem, its consequence, and in brackets its ID:

```text
cart.sdf:42: warning: <cast_shadow> in <light> is not supported; it is ignored [unsupported-element]
```

- An **error** means that the file cannot be used. The command exits with 1.
- A **warning** names something invalid or not supported; reading continues as stated. `--strict` makes every
  warning an error.
- An **info** states a rule that may be unexpected. `trundle check` prints it; `trundle run` does not.

`trundle explain ID` prints the entry of an ID from this page. `trundle check FILE` lists all diagnostics, errors first;
`trundle check FILE --json` prints them as `{"severity", "file", "line", "message", "id"}`. From Python they are in
`sim.report.findings`. An ID keeps its meaning in later versions.
"""


def page() -> str:
    """Return the pages of the registry as sections of one page, with the messages of each ID."""
    return "\n".join([_INTRO, *(_section(path.read_text()) for path in pages())])


def _section(text: str) -> str:
    head, *entries = _HEADING.split(text)
    parts = [f"#{head}"]
    for id, body in zip(entries[::2], entries[1::2], strict=True):
        parts.append(f"### {id} {{ #{id} }}\n{body.rstrip()}\n")
        listed = [f"- {severity}: {cell(message)}" for severity, message in messages().get(id, [])]
        parts += ["Messages:\n", *listed] if listed else []
        parts.append("")
    return "\n".join(parts)


@cache
def messages() -> dict[str, list[tuple[str, str]]]:
    """Return the severity and text of each message, by ID; `…` replaces the variable parts."""
    by_id: dict[str, list[tuple[str, str]]] = {}
    for wing in _WINGS:
        for path in sorted((_SOURCE / wing).rglob("*.py")):
            for id, severity, text in _sentences(ast.parse(path.read_text())):
                if (severity, text) not in by_id.setdefault(id, []):
                    by_id[id].append((severity, text))
    return by_id


def _sentences(tree: ast.AST) -> Iterator[tuple[str, str, str]]:
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            assigned = _assigned(function)
            for call in ast.walk(function):
                if isinstance(call, ast.Call) and len(call.args) >= 3:
                    name = getattr(call.func, "attr", getattr(call.func, "id", ""))
                    message, ids = call.args[1], _texts(call.args[2])
                    values = assigned.get(message.id, []) if isinstance(message, ast.Name) else [message]
                    texts = [_text(value, assigned) for value in values if name in _SEVERITY]
                    yield from ((id, _SEVERITY[name], text) for id in ids for text in texts if _is_specific(text))


def _texts(node: ast.expr) -> list[str]:
    """Return the alternatives of an ID."""
    if isinstance(node, ast.IfExp):
        return [*_texts(node.body), *_texts(node.orelse)]
    return [node.value] if isinstance(node, ast.Constant) and isinstance(node.value, str) else []


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
