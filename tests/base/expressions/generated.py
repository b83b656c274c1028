"""Generated hostile expressions, reproducible from their number.

They call every function, method and operator of expressions with values that are large, deep, shared, or have equal
hashes. The largest values exist beforehand, as if made by earlier expressions, so that a small budget is enough.
"""

import random
from functools import cache
from typing import Any

from tests.base.expressions.names import NAMES

from trundle.base.expressions.functions import GUARDED
from trundle.base.expressions.methods import METHODS_OF

_KEYS = (
    "i",
    "str(i)",
    "i * (2**61 - 1)",  # integers, complex numbers and tuples with equal hashes
    "i * (2**61 - 1) + 233",
    "1j * i - 1000003 * i",
    "(i * (2**61 - 1),)",
    "('a' * 999, i * (2**61 - 1))",
    "frozenset([i * (2**61 - 1)])",
    "frozenset(j * (2**61 - 1) for j in range(i % 99))",
    "float(i * (2**61 - 1))",
    "i << 44",  # the same low bits
    "i / 3",
    "range(i)",
    "-1 - (i % 2)",
    "(lambda: i)",
)
_COLLECTIONS = (
    "set({k} for i in range({n}))",
    "dict(({k}, i) for i in range({n}))",
    "tuple({k} for i in range({n}))",
    "frozenset({k} for i in range({n}))",
    "[{k} for i in range({n})]",
)
_TEXTS = (
    "'a' * 999999",
    "'a' * 999990 + 'b'",
    "'b' + 'a' * 400000",
    "'\\u00e9' * 600000",
    "'\\u0390' * 300000",
    "'a b' * 300000",
    "'1' * 4300",
    "'f' * 25000",
    "'0.' + '1' * 900000",
    "'{{}}' * 300000",
    "'%s' * 300000",
    "'%9999d' * 99",
    "'\\t' * 900000",
)
_NUMBERS = (
    "2**49999",
    "3**49000",
    "1 << 99998",
    "-1",
    "0.1",
    "1e308",
    "5e-324",
    "1j",
    "True",
    "2**61 - 1",
    "inf",
    "0",
    "3",
    "999",
    "10**6",
)
_GROUPS = (
    "[[0] * 1000] * 300",
    "[0.1] * 90000",
    "[2**9999] * 30",
    "['a' * 99990 + 'b'] * 9",
    "[i % 7 for i in range(250000)]",
    "[str(i) for i in range(100000)]",
    "dict((str(i), i) for i in range(100000))",
    "set(str(i) for i in range(100000))",
    "range(1000000)",
    "range(0, 2**61, 2**42)",
    "slice(2**61)",
    "(lambda d: d(d, 0, [1]))(lambda d, n, x: d(d, n + 1, [x, x]) if n < 16 else x)",
    "(lambda d: d(d, 0, (1,)))(lambda d, n, x: d(d, n + 1, (x, x)) if n < 16 else x)",
    "[frozenset(j * (2**61 - 1) for j in range(i, 300)) for i in range(20)]",
)
_COLLISIONS = (
    "set(i * (2**61 - 1) for i in range(7000))",
    "frozenset(i * (2**61 - 1) for i in range(7000))",
    "dict((i * (2**61 - 1), i) for i in range(7000))",
    "dict((233 + i * (2**61 - 1), 'a') for i in range(7000))",
)
_ITERATORS = ("(i for i in {a})", "map(lambda i: i, {a})", "enumerate({a})", "zip({a}, {a})", "reversed({a})")
_VIEWS = ("{a}.keys()", "{a}.items()", "{a}.values()", "{a}.copy()", "{a}[::2]", "*{a}", *_ITERATORS)
_OPERATORS = ("+", "-", "*", "/", "//", "%", "**", "<<", ">>", "&", "|", "^", "==", "!=", "<", "<=", ">=", "in", "and")
_FORMATS = (
    "'%s' % {a}",
    "'{{}}'.format({a})",
    "f'{{{a}!r:>9}}'",
    "'%(k)s' % {a}",
    "'%.9999f' % {a}",
    "{a}.format({b})",
)
_DISPLAYS = ("{a}[{b}]", "{a}[{b}:]", "[*{a}, *{b}]", "{{*{a}, *{b}}}", "{{**{a}, **{b}}}", "(lambda *x, **k: x)(*{a})")
_MUTATING = "add append clear discard extend insert pop popitem remove reverse setdefault sort update"
_FUNCTIONS = sorted(function.__name__ for function in GUARDED)
_METHODS = [(kind.__name__, name) for kind, names in METHODS_OF.items() for name in sorted(names)]
_REPEATS = ("2", "100", "10**6")


@cache
def names() -> dict[str, Any]:
    """Return the names of expressions: functions, texts `t0` …, numbers `n0` …, colliding keys `a0` …, others `g0` …"""
    return {**NAMES, **{name: eval(text, {**NAMES}) for name, text in _sources().items()}}


@cache
def _sources() -> dict[str, str]:
    colliding = [collection.format(k=key, n=1000) for key in _KEYS for collection in _COLLECTIONS]
    return {
        **{f"t{i}": text.replace("{{}}", "{}") for i, text in enumerate(_TEXTS)},
        **{f"n{i}": text for i, text in enumerate(_NUMBERS)},
        **{f"a{i}": text for i, text in enumerate(_COLLISIONS)},
        **{f"g{i}": text for i, text in enumerate((*_GROUPS, *colliding))},
    }


@cache
def _named(kind: str) -> list[str]:
    """Return the names of values of a type, or all names if there are none."""
    values = names()
    return [name for name in _sources() if type(values[name]).__name__ == kind] or list(_sources())


def generated_expression(number: int) -> str:
    """Return the expression of a number."""
    rng = random.Random(number)
    body = _operation(rng, _value(rng), _value(rng))
    if rng.random() < 0.4:
        body = _operation(rng, body, _value(rng))
    repeats = rng.choice(_REPEATS)
    return rng.choice(
        (
            body,
            f"[{body} for _ in range({repeats})]",
            f"[h.append({body}) for h in [[]] for _ in range({repeats})]",
            f"(lambda f: f(f, {repeats}))(lambda f, n: [{body}] and f(f, n - 1))",
            f"sorted([1] * {repeats}, key=lambda _: {body})",
        )
    )


def _value(rng: random.Random) -> str:
    kind = rng.choice(("t", "n", "a", "g", "g", "g"))
    name = rng.choice([name for name in _sources() if name.startswith(kind)])
    return rng.choice(_VIEWS).format(a=name) if rng.random() < 0.2 and kind == "g" else name


def _operation(rng: random.Random, a: str, b: str) -> str:
    match rng.randrange(6):
        case 0 | 1:
            if rng.random() < 0.7:  # mostly of one type, as others are refused at once
                kind = rng.choice(("a", "a", "set", "frozenset", "dict", "str", "list"))
                a, b = rng.choices(_named(kind) if kind != "a" else ["a0", "a1", "a2", "a3"], k=2)
                b = rng.choice((a, b))
                a, b = (rng.choice((name, name, f"{name}.keys()")) for name in (a, b))
            return f"({a} {rng.choice(_OPERATORS)} {b})"
        case 2:
            return rng.choice((*_FORMATS, *_DISPLAYS)).format(a=a, b=b)
        case 3 | 4:
            kind, name = rng.choice(_METHODS)
            owner = rng.choice(_named(kind))
            b = rng.choice((b, rng.choice(_named(kind))))
            arguments = rng.choice(("", b, b, f"{b}, {a}", f"{b}, 'a', 1", "'a', 'b'", f"({b},) * 999"))
            return f"{owner}{'.copy()' if name in _MUTATING else ''}.{name}({arguments})"
        case _:
            arguments = rng.choice((a, a, a, f"{a}, {b}", f"*{a}", f"{b}, {a}, 2", f"lambda i: i, {a}"))
            return f"{rng.choice(_FUNCTIONS)}({arguments})"
