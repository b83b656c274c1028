"""Names are terms of the field: a list of words that were in use here and are not."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import trundle

SOURCE = Path(trundle.__file__).parent
CPP = SOURCE.parents[1] / "cpp"
REPLACED_NEXT = SOURCE / "viewer"

MODULES = {
    "beat", "between", "doors", "doubts", "errands", "exposure", "feeling", "grip", "lowest", "makers", "nearby",
    "noted", "notices", "outcome", "outgoing", "posted_calls", "postmortem", "pushes", "shelf", "showing", "sight",
    "stage", "surroundings", "told_time", "touching", "typed", "unremarkable", "unseen", "wrapped",
}  # fmt: skip
CLASSES = {
    "Beat", "Between", "Errands", "Feeling", "Grip", "Hold", "Instant", "Looker", "Makers", "Misfit", "Noted",
    "Notices", "Outcome", "Outgoing", "Patience", "Puppet", "Pushes", "Runaway", "Scenery", "Shelf", "Showing",
    "Sight", "Site", "Spot", "Stage", "Surroundings", "ToldTime", "Touch", "Touching",
}  # fmt: skip
CPP_TYPES = {
    "Around", "Bundle", "Coarse", "Fan", "Frame", "LetGo", "Look", "Meeting", "Pipe", "Raised", "Room", "Shot", "Sight",
    "Solid", "Waiting",
}  # fmt: skip
VERBS = {"attend", "feel", "gather", "give", "heed", "hear", "lay", "look", "obey", "strike", "take", "tell", "told"}
"""First words of functions; what a sensor does is `measure`, what a topic does is `publish`."""

TERMS = {"give_up", "look_ahead", "look_up"}
"""Terms that begin with such a word."""


def _sources() -> Iterator[Path]:
    return (file for file in sorted(SOURCE.rglob("*.py")) if REPLACED_NEXT not in file.parents)


def _definitions(kinds: tuple[type[ast.AST], ...]) -> Iterator[tuple[str, str]]:
    """Place and name of each definition, without leading underscores."""
    for file in _sources():
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, kinds):
                name: str = node.name  # type: ignore[attr-defined]
                yield f"{file.relative_to(SOURCE)}:{node.lineno}", name.lstrip("_")  # type: ignore[attr-defined]


def test_modules_are_named_by_the_field() -> None:
    assert [file for file in _sources() if file.stem in MODULES] == []


def test_classes_are_named_by_the_field() -> None:
    assert [(where, name) for where, name in _definitions((ast.ClassDef,)) if name in CLASSES] == []


def test_functions_begin_with_verbs_of_the_field() -> None:
    found = _definitions((ast.FunctionDef, ast.AsyncFunctionDef))

    assert [(where, name) for where, name in found if name.split("_")[0] in VERBS and name not in TERMS] == []


def test_types_in_cpp_are_named_by_the_field() -> None:
    sources = [file for file in sorted(CPP.glob("*")) if file.suffix in (".cc", ".h")]
    types = [
        (file.name, name) for file in sources for name in re.findall(r"\b(?:struct|class) (\w+)", file.read_text())
    ]

    assert [(where, name) for where, name in types if name in CPP_TYPES] == []
