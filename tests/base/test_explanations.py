"""Every ID of a finding is explained, and every explained ID comes from the code."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import trundle
from trundle.base.diagnostics import Diagnostics, Source, UsageError
from trundle.base.explanations import explain, explanations, pages

_SOURCE = Path(trundle.__file__).parent
_REPORTS = {"warn": 2, "info": 2, "warn_error": 3, "DescriptionError": 2, "UnknownArgumentError": 2}
"""Function → index of the argument that is the ID."""
_REPORTING = re.compile(r"report\.(?:warn|info)|DescriptionError\(|\bid ?= ?\"")
_RECEIVERS = ("report", "_report")
_WINGS = ("base", "robots", "sim", "gazebo", "live")
"""Wings that read what `trundle check`, `run` and `launch` read."""
_WITHOUT = {
    "base/diagnostics.py",  # passes on what it is given
    "live/loaded_simulation.py",  # a log of what was started, which no command prints
    "robots/repositories",  # lists of `trundle pack`
    "sim/simulation/state_log.py",  # recordings
}

_WITHOUT_EXAMPLE = {"engine"}
"""No file is known that MuJoCo refuses after Trundle's own checks."""


@cache
def _trees() -> list[tuple[Path, ast.Module]]:
    """Return the files that report or raise findings, parsed."""
    files = [(path, path.read_text()) for path in sorted(_SOURCE.rglob("*.py"))]
    return [(path, ast.parse(text)) for path, text in files if _REPORTING.search(text)]


def _calls() -> Iterator[tuple[str, ast.Call, int]]:
    for path, tree in _trees():
        for call in ast.walk(tree):
            if not isinstance(call, ast.Call):
                continue
            function = call.func
            name = getattr(function, "attr", getattr(function, "id", ""))
            is_method = isinstance(function, ast.Attribute)
            receiver = ast.unparse(function.value).rpartition(".")[2] if is_method else ""
            if name in _REPORTS and (not is_method or receiver in _RECEIVERS):
                yield f"{path.relative_to(_SOURCE)}:{call.lineno}", call, _REPORTS[name]


def _emitted() -> set[str]:
    """Return the IDs in the code: of reporting calls, `id=` of errors, and `id = …`."""
    values = [call.args[index] for _, call, index in _calls() if len(call.args) > index]
    for _, tree in _trees():
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "").endswith("Error"):
                values += [keyword.value for keyword in node.keywords if keyword.arg == "id"]
            elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "id":
                values.append(node.value)
    return {text for value in values for text in _texts(value)} - {""}


def _texts(value: ast.expr) -> list[str]:
    """Return the alternatives of an ID; none where an error's own is passed on."""
    if isinstance(value, ast.IfExp):
        return [*_texts(value.body), *_texts(value.orelse)]
    return [value.value] if isinstance(value, ast.Constant) and isinstance(value.value, str) else []


def test_the_ids_of_the_code_are_those_of_the_registry() -> None:
    assert _emitted() == set(explanations())


def test_a_finding_about_what_is_read_has_an_id() -> None:
    without = [
        place
        for place, call, index in _calls()
        if len(call.args) <= index and place.startswith(_WINGS) and not place.startswith(tuple(_WITHOUT))
    ]
    assert without == []


def test_an_id_is_on_one_page_once_and_legal() -> None:
    headings = [line[3:] for page in pages() for line in page.read_text().splitlines() if line.startswith("## ")]

    assert len(headings) == len(set(headings))
    assert [heading for heading in headings if not re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", heading)] == []


@pytest.mark.parametrize("id", explanations())
def test_an_entry_is_whole(id: str) -> None:
    entry = explain(id)

    assert entry.meaning.endswith(".")
    assert entry.remedy[0].islower() or entry.remedy.startswith("`")
    assert entry.files or id in _WITHOUT_EXAMPLE
    assert "```" not in entry.text()


def test_an_unknown_id_names_similar_ones() -> None:
    with pytest.raises(UsageError, match="'impossible-inertia'"):
        explain("imposible-inertia")
    with pytest.raises(UsageError, match="`trundle explain` lists all"):
        explain("xyzzy42")


def test_a_printed_finding_ends_with_its_id() -> None:
    report = Diagnostics()
    report.warn(Source("cart.sdf", 3), "the mass is zero", "impossible-inertia")

    assert report.printed_warnings() == ["cart.sdf:3: warning: the mass is zero [impossible-inertia]"]
    assert report.warnings == ["cart.sdf:3: warning: the mass is zero"]
    assert report.findings[0].as_json()["id"] == "impossible-inertia"
