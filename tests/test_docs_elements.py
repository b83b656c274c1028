"""The references of SDF and URDF have all elements that readers read."""

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.docs_blocks import ROOT

import trundle

SOURCE = Path(trundle.__file__).parent
READING_METHODS = {"find", "all", "attribute", "string", "number", "integer", "flag", "vector", "required_attribute"}


@pytest.mark.parametrize(("kind", "readers"), [("sdf", "robots/description/sdf"), ("urdf", "robots/robot")])
def test_every_element_of_a_reader_is_in_the_reference(
    kind: str, readers: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A new element with a new parent must be added to docs/generate/every_element.*."""
    if not (ROOT / "docs/generate").is_dir():
        pytest.skip("the documentation is not part of the sdist")
    monkeypatch.setattr(sys, "path", [str(ROOT / "docs"), *sys.path])
    from generate import elements

    inventory = elements.read_inventory(elements.HERE / f"every_element.{kind}")
    tables = [*inventory.children.values(), *inventory.attributes.values()]
    recorded = {name for names in tables for name in names}

    named = {name for file in (SOURCE / readers).rglob("*.py") for name in _read_names(ast.parse(file.read_text()))}
    assert len(named) > 20
    assert sorted(named - recorded) == []


def _read_names(tree: ast.AST) -> Iterator[str]:
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and getattr(call.func, "attr", "") in READING_METHODS and call.args:
            name = call.args[0]
            if isinstance(name, ast.Constant) and isinstance(name.value, str):
                yield name.value
