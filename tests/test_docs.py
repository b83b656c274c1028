"""Examples of the documentation work as documented."""

import doctest
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def test_what_python_md_shows_is_what_happens(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    options = doctest.ELLIPSIS
    failed, tried = doctest.testfile(str(ROOT / "docs/python.md"), module_relative=False, optionflags=options)
    assert tried > 30
    assert failed == 0
