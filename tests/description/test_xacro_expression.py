"""Expressions of a hostile xacro file end soon, and in a sentence."""

from pathlib import Path

import pytest

from trundle.description import expand_xacro
from trundle.description.xacro_expression import bounded_eval
from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.packages import Packages


def expand(folder: Path, body: str) -> str:
    file = folder / "x.xacro"
    file.write_text(f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">{body}</robot>')
    return expand_xacro(file, {}, packages=Packages({}, start=folder), report=Diagnostics())


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("2**10", 1024),
        ("3 * 'ab'", "ababab"),
        ("2*3.5", 7.0),
        ("1 << 4", 16),
        ("[x*x for x in range(4)]", [0, 1, 4, 9]),
    ],
)
def test_honest_expressions_have_their_values(expression: str, value: object) -> None:
    symbols = {"range": range}
    assert bounded_eval(expression, symbols) == value
    assert set(symbols) == {"range", "__builtins__"}


@pytest.mark.parametrize(
    "expression",
    [
        "9**9**9",
        "'a' * 10**9",
        "[0] * 10**9",
        "1 << 10**9",
        "range(10**12)",
        "[x + y for x in range(10**6) for y in range(10**6)]",
        "().__class__",
        "__import__('os')",
        "open('/etc/passwd')",
        "(" * 300 + ")" * 300,
    ],
)
def test_hostile_expressions_are_refused(tmp_path: Path, expression: str) -> None:
    with pytest.raises(DescriptionError):
        expand(tmp_path, f'<link name="${{{expression}}}"/>')


def test_eval_substitutions_are_bounded_too(tmp_path: Path) -> None:
    assert 'name="3m"' in expand(tmp_path, "<link name=\"$(eval [str][0:1] and '3' + 'm')\"/>")
    with pytest.raises(DescriptionError, match=r"error: a power of more than 100000 bits$"):
        expand(tmp_path, '<link name="$(eval 9**9**9)"/>')
    with pytest.raises(DescriptionError, match="name 'exec' is not defined"):
        expand(tmp_path, '<link name="$(eval exec)"/>')


def test_macros_that_double_are_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.description.xacro._MOST_ELEMENTS", 2000)
    macros = '<xacro:macro name="m0"><link name="l"/></xacro:macro>' + "".join(
        f'<xacro:macro name="m{i + 1}"><xacro:m{i}/><xacro:m{i}/></xacro:macro>' for i in range(40)
    )

    with pytest.raises(DescriptionError, match="more than 2000 elements"):
        expand(tmp_path, f"{macros}<xacro:m40/>")
