"""Expressions have the same values and errors as in Python."""

import warnings
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, strategies as st
from tests.base.expressions.names import NAMES, evaluate

from trundle.base.expressions import Interpreter

_VALUES: dict[str, Any] = {"x": 3, "y": 0.25, "s": "a_b", "items": [3, 1, 2], "d": {"a": 1, "b": [2]}, "f": float}


def result_of(evaluate_text: Callable[[str], object], text: str) -> object:
    """Return the type and text of the value, or the type of the error."""
    try:
        value = evaluate_text(text)
        return type(value).__name__, repr(value)
    except Exception as error:
        return type(error)


def python_result(text: str) -> object:
    def evaluate_text(text: str) -> object:
        return eval(text, {"__builtins__": {}, **NAMES, **_VALUES})

    with warnings.catch_warnings():  # as of `1[0]`, which is legal
        warnings.simplefilter("ignore")
        return result_of(evaluate_text, text)


def trundle_result(text: str) -> object:
    def evaluate_text(text: str) -> object:
        return evaluate(text, **_VALUES)

    return result_of(evaluate_text, text)


_OPERANDS = """
    2
    0.5
    -3
    0
    x
    y
    s
    'ab'
    ''
    [1, x]
    (x, y)
    {1, x}
    {'k': x}
    d
    d['a']
    items
    items[1:]
    s[-1]
    f(2)
    len(s)
    True
    None
    s.upper()
    '%s' % x
    '%.2f' % y
    '{:>6}'.format(x)
    f'{x:03d}{y!r}'
    max(x, 1)
    min(items)
    sorted(items)
    sum(items)
    round(y, 1)
    abs(-x)
    str(x)
    int('7')
    list(range(x))
    [i * x for i in items if i > 1]
    {i: -i for i in items}
    {i % 2 for i in items}
    (lambda a, b=2: a * b)(x)
    list(map(lambda i: i + x, items))
    tuple(zip(items, s))
    dict(a=1, **d)
    [*items, x]
    x if y else s
    s.split('_')
    '-'.join(s)
    s.replace('a', 'b')
    d.get('b')
    list(d.items())
    isinstance(x, int)
    divmod(7, x)
    1 < x < 5
    ~x
    10**x
    [a + b for a, b in [(1, 2)]]
    [i for r in [[1], [2, 3]] for i in r]
    sin(y)
    floor(y)
    hypot(3, 4)
    any(items)
    all([])
    1 << x
    pi
    [*map(str, items)][::-1]
    (lambda *a, **k: (a, k))(1, *items, k=2)
    list(enumerate(s))
    list(reversed(items))
    not x
    +x
    x is None
"""
_OPERATORS = "+ - * / // % < == != >= and or in | & ^"
_OPERAND_LIST = [line.strip() for line in _OPERANDS.strip().splitlines()]
_EXPRESSIONS = st.recursive(
    st.sampled_from(_OPERAND_LIST),
    lambda inner: st.one_of(
        st.tuples(
            inner,
            st.sampled_from(_OPERATORS.split()),
            inner,
        ).map(lambda parts: f"({' '.join(parts)})"),
        st.tuples(st.sampled_from(["not ", "-", "len", "str", "list", "sorted", "bool", "sum"]), inner).map(
            lambda parts: f"{parts[0]}({parts[1]})"
        ),
        st.tuples(inner, inner, inner).map(lambda parts: "({} if {} else {})".format(*parts)),
        st.tuples(inner, inner).map(lambda parts: "({})[{}]".format(*parts)),
        st.tuples(inner, inner).map(lambda parts: "[{} for v in ({})]".format(*parts)),
        st.tuples(inner, inner).map(lambda parts: "(lambda v: {})({})".format(*parts)),
    ),
    max_leaves=6,
)


@given(_EXPRESSIONS)
def test_generated_expressions_agree_with_python(text: str) -> None:
    assert trundle_result(text) == python_result(text)


@pytest.mark.parametrize(
    "text",
    [
        *_OPERAND_LIST,
        "[i() for i in [lambda: k for k in range(3)]]",  # as late as in Python
        "[[i + j for j in range(i)] for i in range(4)]",
        "[x for x in [x]]",
        "(lambda x: [x for y in [1]])(9)",
        "(lambda f: f(f, 5))(lambda f, n: 1 if n < 2 else n * f(f, n - 1))",
        "(lambda a, /, b, *c, d=4, **e: (a, b, c, d, e))(1, 2, 3, d=5, z=6)",
        "(lambda a, b=x: a + b)(1)",
        "(lambda a: a)()",
        "(lambda a: a)(1, 2)",
        "(lambda a: a)(1, a=2)",
        "(lambda a: a)(b=2)",
        "[a for a, *b in [(1, 2, 3)]]",
        "[b for a, *b, c in ['abcd', 'xy']]",
        "[a for a, b in [(1,)]]",
        "sum((i for i in items), 10)",
        "sum(['a', 'b'])",
        "sum([[1], [2]], [])",
        "max(items, key=lambda i: -i)",
        "max([], default=7)",
        "max([])",
        "min('b', 'a')",
        "sorted(items, key=lambda i: -i, reverse=True)",
        "sorted([1, 'a'])",
        "'%(a)s %(b)s' % d",
        "'%d' % 'a'",
        "'%s %s' % (1,)",
        "'{} {}'.format(1, 2)",
        "'{1} {0}'.format(1, 2)",
        "'{a}'.format(a=1)",
        "'{a}'.format_map(d)",
        "'{}'.format()",
        "'{0} {}'.format(1)",
        "'{:{}}'.format(x, 9)",
        "'{!r:>5}'.format('a')",
        "'{{}}'.format()",
        "'{'.format()",
        "f'{s:>{x}}'",
        "f'{x!r:>5}|{y:.1e}|{{}}'",
        "f'{d}'",
        "s.nothing",
        "s.nothing()",
        "x.real + y.imag",
        "(5).bit_length()",
        "d['nothing']",
        "items[9]",
        "items['a']",
        "x()",
        "nothing",
        "1 / 0",
        "0.0 ** -1",
        "int('a')",
        "float('nan') != float('nan')",
        "1e308 * 10",
        "10**30 % 7",
        "-7 // 2, -7 % 3, 7 // -2.0",
        "2 ** -1",
        "True + True",
        "'a' in 'abc', 'a' in d, 1 in items, 1.0 in range(3), 'x' not in s",
        "[1, [2]] == [1, [2]]",
        "{1, 2} | {3}, {1, 2} - {1}, {1: 2} | {3: 4}",
        "'a' < 'b' <= 'c' != 1",
        "[h.append(4) or h for h in [[1]]]",
        "[h.update(c=3) or h for h in [{'a': 1}]]",
        "[h.sort(key=lambda i: -i) or h for h in [[1, 3, 2]]]",
        "[h.add(3) or h for h in [{1}]]",
        "str.upper('a'), list(map(str.strip, [' a ']))",
        "type(x) == int, type(x).__len__ if False else 1",
        "isinstance(x, (int, str)), issubclass(bool, int)",
        "'a,b;c'.partition(','), ' x '.strip(), 'abc'.find('c'), 'abc'.center(7, '*')",
        "'abc'.translate({97: 'x'}), 'a\\tb'.expandtabs(4), 'x'.zfill(3), 'ab'.join(['1', '2'])",
        "s.__len__()",
        "  3",
        "0x10 + 0b1 + 1_000",
        "1 if",
        "",
        "x = 1",
    ],
)
def test_typical_expressions_agree_with_python(text: str) -> None:
    expected = python_result(text.strip())
    assert trundle_result(text) == expected


def test_expressions_do_not_change_their_names() -> None:
    names = {"a": [3, 1]}
    Interpreter().evaluate("[a for a in [1]] + (lambda a: [a])(2)", names)
    assert names == {"a": [3, 1]}
