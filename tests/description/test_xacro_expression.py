"""Expressions of a hostile xacro file end soon, and in a sentence."""

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from trundle.description import expand_xacro
from trundle.description.xacro import xacro
from trundle.description.xacro_expression import Evaluator
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
        ("(lambda x, y=2: x*y + 1)(4)", 9),
        ("'-'.join(['a', 'b']).replace('a', 'cc').ljust(6, '.')", "cc-b.."),
        ("'%s_%.2f' % ('a', 1.5) + '{:>3}'.format(7)", "a_1.50  7"),
        ("f'{1.5:.2f}{7!r}'", "1.507"),
        ("[1] + [2]", [1, 2]),
    ],
)
def test_honest_expressions_have_their_values(expression: str, value: object) -> None:
    assert Evaluator()(expression, {"range": range, "len": len}) == value


_OPERANDS = ["2", "0.5", "-3", "x", "y", "s", "'ab'", "[1, x]", "f(2)", "len(s)", "s.upper()", "'%s' % x", "max(x, 1)"]
_EXPRESSIONS = st.recursive(
    st.sampled_from(_OPERANDS),
    lambda inner: st.tuples(inner, st.sampled_from(["+", "-", "*", "/", "//", "%", "<", "==", "and"]), inner).map(
        lambda three: f"({' '.join(three)})"
    ),
    max_leaves=5,
)


@given(_EXPRESSIONS)
def test_any_expression_means_what_it_means_to_xacro(expression: str) -> None:
    def value_by(evaluate: Any) -> object:
        symbols = {"x": 3, "y": 0.25, "s": "a_b", "f": float, "len": len, "max": max}
        try:
            return repr(evaluate(expression, symbols))
        except Exception as error:
            return type(error)

    assert value_by(Evaluator()) == value_by(xacro.safe_eval)


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
        "-" * 100_000 + "1",
        "'a'.ljust(10**10)",
        "list(map(str.ljust, ['a'], [10**10]))",
        "'%9999999999d' % 1",
        "('a' * 1000000).join([''] * 1000000)",
        "('a' * 1000000).replace('a', 'a' * 1000000)",
        r"('a\t' * 1000).expandtabs(10**6)",
        "(lambda x: x + x)(" * 30 + "'a'" + ")" * 30,
        "(lambda f, n: f(f, n))(lambda f, n: f(f, n - 1) + f(f, n - 1) if n else 1, 60)",
        "max(map(lambda x: max(map(lambda y: y, range(10**6))), range(10**6)))",
        "factorial(10**6)",
        "lcm(*range(1, 10**5))",
        "prod(range(1, 10**5))",
        "python.vars(python.type)",
    ],
)
def test_hostile_expressions_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, expression: str) -> None:
    monkeypatch.setattr("trundle.description.xacro_expression._MOST_TURNS", 20_000)
    with pytest.raises(DescriptionError) as error:
        expand(tmp_path, f'<link name="${{{expression}}}"/>')
    assert len(str(error.value)) < 1000


def test_eval_substitutions_are_bounded_too(tmp_path: Path) -> None:
    assert 'name="3m"' in expand(tmp_path, "<link name=\"$(eval [str][0:1] and '3' + 'm')\"/>")
    with pytest.raises(DescriptionError, match=r"error: a number of more than 100000 bits$"):
        expand(tmp_path, '<link name="$(eval 9**9**9)"/>')
    with pytest.raises(DescriptionError, match="name 'exec' is not defined"):
        expand(tmp_path, '<link name="$(eval exec)"/>')
    with pytest.raises(DescriptionError, match="the format '9999999999' is not supported"):
        expand(tmp_path, "<link name=\"$(eval f'{1:9999999999}')\"/>")


def test_a_property_is_worked_out_amid_another(tmp_path: Path) -> None:
    """What is worked out when first asked for, in the middle of an expression, leaves that one as it was."""
    properties = "".join(
        f'<xacro:property name="{name}" value="{value}"/>'
        for name, value in {"x": "2", "a": "${x*2}", "b": "${x*3}", "f": "${lambda q: q*2}"}.items()
    )

    text = expand(tmp_path, f'{properties}<link name="${{a*2 + b*3}}_${{f(4)*3 + x*a}}"/>')

    assert '<link name="26_32"/>' in text


def doubled(first: str, then: str) -> str:
    """A property a0, and forty more, each made of the one before; then the last."""
    return first + "".join(then.format(i + 1, i) for i in range(40))


@pytest.mark.parametrize(
    "body",
    [
        doubled('<xacro:property name="a0" value="aaaa"/>', '<xacro:property name="a{0}" value="${{a{1}}}${{a{1}}}"/>')
        + '<link name="${a40}"/>',
        doubled('<xacro:property name="a0" value="aaaa"/>', '<xacro:property name="a{0}" value="${{a{1} + a{1}}}"/>')
        + '<link name="${a40}"/>',
        doubled('<xacro:property name="a0" value="${[1]}"/>', '<xacro:property name="a{0}" value="${{[a{1}]*2}}"/>')
        + '<link name="${a40}"/>',
    ],
)
def test_properties_that_double_are_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, body: str) -> None:
    monkeypatch.setattr("trundle.description.xacro_expression._MOST_ITEMS", 20_000)
    with pytest.raises(DescriptionError, match="more than 20000"):
        expand(tmp_path, body)


def test_lists_of_a_file_that_hold_one_another_are_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.description.xacro_expression._MOST_ITEMS", 20_000)
    lists = [f"{chr(98 + i)}: &{chr(98 + i)} [{', '.join([f'*{chr(97 + i)}'] * 9)}]" for i in range(9)]
    (tmp_path / "bomb.yaml").write_text("\n".join(["a: &a [x, x, x]", *lists]))

    with pytest.raises(DescriptionError, match="more than 20000 characters or items"):
        expand(tmp_path, "<link name=\"${xacro.load_yaml('bomb.yaml')}\"/>")


def test_blocks_that_double_are_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.description.xacro._MOST_ELEMENTS", 2000)
    block = '<xacro:property name="a{0}"><xacro:insert_block name="a{1}"/><xacro:insert_block name="a{1}"/>'
    bomb = doubled('<xacro:property name="a0"><!-- nothing --></xacro:property>', f"{block}</xacro:property>")

    with pytest.raises(DescriptionError, match="more than 2000 elements"):
        expand(tmp_path, f'{bomb}<xacro:insert_block name="a40"/>')


def test_macros_that_double_are_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.description.xacro._MOST_ELEMENTS", 2000)
    macros = '<xacro:macro name="m0"><link name="l"/></xacro:macro>' + "".join(
        f'<xacro:macro name="m{i + 1}"><xacro:m{i}/><xacro:m{i}/></xacro:macro>' for i in range(40)
    )

    with pytest.raises(DescriptionError, match="more than 2000 elements"):
        expand(tmp_path, f"{macros}<xacro:m40/>")


def test_a_file_that_is_far_too_large_is_not_read_into_memory(tmp_path: Path) -> None:
    file = tmp_path / "x.xacro"
    with file.open("wb") as hole:
        hole.truncate(100_000_000)

    with pytest.raises(DescriptionError, match=r"x\.xacro: error: larger than 67108864 bytes"):
        expand_xacro(file, {}, packages=Packages({}, start=tmp_path), report=Diagnostics())
