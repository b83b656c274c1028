"""Expressions that would exhaust memory or time: each is refused with a message, quickly and in little memory."""

import math
import re
import resource
import subprocess
import sys
import tracemalloc

import pytest
from tests.base.expressions.names import NAMES, evaluate

from trundle.base.expressions import Budget, ExpressionError, Interpreter

_STEPS = r"may take at most \d+ steps"
_MEMORY = r"may make at most \d+ MiB of values"
_BITS = "a number of more than 100000 bits"
_LONG = "a text, list or range of more than 1000000 items"
_SIZE = "a value of more than 1000000 characters or items"
_FORMAT = "the format .* is not supported"
_DEEP = "nested too deeply"
_DIGITS = "Exceeds the limit"
_CPU = "s of the processor"
_COLLIDING_KEYS = (
    "j * (2**61 - 1)",
    "1j * j - 1000003 * j",
    "(j * (2**61 - 1),)",
    "('a' * 99, j * (2**61 - 1))",
    "frozenset([j * (2**61 - 1)])",
)
"""Keys with equal hashes."""
_COLLIDING_SETS = "*[frozenset(j * (2**61 - 1) for j in range(1000)) for _ in range(2)],"
_DOUBLE = "(lambda d: d(d, 0, {0}))(lambda d, n, x: d(d, n + 1, {1}) if n < 45 else {2})"

BOMBS = [
    # Loops.
    ("[x for x in range(10**6) for y in range(10**6) if False]", _STEPS),
    ("sum(x for x in range(10**6) for y in range(10**6))", _STEPS),
    ("[[[1 for x in range(10**6)] for y in range(10**6)] for z in range(10**6)]", _STEPS),
    ("max(map(lambda x: max(map(lambda y: y, range(10**6))), range(10**6)))", _STEPS),
    ("list(filter(lambda x: False, range(10**6))) or all(1 for x in range(10**6) for y in range(10**6))", _STEPS),
    ("(lambda f, n: f(f, n))(lambda f, n: f(f, n - 1) + f(f, n - 1) if n else 1, 60)", _STEPS),
    ("any(1.5 in range(10**6) for _ in range(10**5))", _STEPS),
    ("(lambda h: [h.append(x) for x in h])([1])", _STEPS),
    ("range(10**12)", _LONG),
    ("(lambda f: f(f))(lambda f: f(f))", _DEEP),
    # Many values.
    ("[[0] * 1000000 for _ in range(400)]", _MEMORY),
    ("[['a'] * 1000000 for _ in range(400)]", _MEMORY),
    ("[[] for _ in range(10**6) for _ in range(100)]", f"{_STEPS}|{_MEMORY}"),
    ("[{1} for _ in range(10**6)]", _MEMORY),
    ("[{i: i} for i in range(10**6)]", f"{_STEPS}|{_MEMORY}"),
    ("[(j for j in [1]) for i in range(10**6)]", f"{_STEPS}|{_MEMORY}"),
    ("[(lambda: 1) for i in range(10**6)]", f"{_STEPS}|{_MEMORY}"),
    ("[map(str, [1]) for i in range(10**6)]", f"{_STEPS}|{_MEMORY}"),
    ("[i.bit_length for i in range(10**6)]", f"{_STEPS}|{_MEMORY}"),
    ("[list(range(999999)) for _ in range(10**5)]", f"{_STEPS}|{_MEMORY}"),
    ("[x[:] for x in [[1] * 900000] for _ in range(10**5)]", _MEMORY),
    ("[x[1:] for x in ['a' * 900000] for _ in range(10**5)]", _MEMORY),
    ("[*[0] * 900000, *[0] * 900000]", _LONG),
    ("(lambda *x: x)(*[0] * 900000, *[0] * 900000)", _LONG),
    ("len(list(zip(*[range(999999)] * 1000)))", _STEPS),
    ("[('a b ' * 200000).split() for _ in range(9)]", f"{_STEPS}|{_MEMORY}"),
    ("[dict(a).copy() for a in [dict([(i, i) for i in range(30000)])] for _ in range(1000)]", f"{_STEPS}|{_MEMORY}"),
    ("(lambda h: [h.extend(h) for _ in range(100)])([1])", _LONG),
    ("sum([[0] * 1000] * 100000, [])", _SIZE),
    ("sum([[0] * 1000 for _ in range(300)], [])", f"{_STEPS}|{_MEMORY}"),
    # Long values.
    ("[0] * 10**9", _LONG),
    ("(0,) * 10**9", _LONG),
    ("'a' * 10**9", _LONG),
    ("'a' * 1000000 + 'a'", _LONG),
    ("(lambda x: x + x)(" * 30 + "'a'" + ")" * 30, _LONG),
    ("'a'.ljust(10**10)", _LONG),
    ("'a'.center(10**10, ' ')", _LONG),
    ("'1'.zfill(10**10)", _LONG),
    ("list(map(str.ljust, ['a'], [10**10]))", _LONG),
    (r"('a\t' * 1000).expandtabs(10**6)", _LONG),
    ("('a' * 1000000).join([''] * 1000000)", _LONG),
    ("('a' * 1000000).replace('a', 'a' * 1000000)", _LONG),
    ("('a' * 1000000).replace('', 'aa')", _LONG),
    ("('a' * 1000000).translate({97: 'aaaa'})", _LONG),
    ("[('a' * 999999).upper() for _ in range(10**6)]", f"{_STEPS}|{_MEMORY}"),
    ("str([['a' * 99999] * 99] * 999)", _SIZE),
    ("[['a' * 99999] * 99] * 999", _SIZE),
    # Formats.
    ("'%9999999999d' % 1", _FORMAT),
    ("'%.9999999999f' % 1", _FORMAT),
    ("'%*d' % (10**9, 1)", _FORMAT),
    ("'%9999d' * 1000 % ((1,) * 1000)", _LONG),
    ("'%(a)s' * 1000 % {'a': 'a' * 9999}", _LONG),
    ("'%s' * 9999 % (('a' * 9999,) * 9999)", _SIZE),
    ("'{:9999999999}'.format(1)", _FORMAT),
    ("'{:{}}'.format(1, 10**9)", _FORMAT),
    ("('{0:9999}' * 1000).format(1)", _LONG),
    ("f'{1:9999999999}'", _FORMAT),
    ("f'{1:{10**9}}'", _FORMAT),
    ("['%9999d' % 1 for _ in range(10**5)]", _MEMORY),
    # Numbers.
    ("9**9**9", _BITS),
    ("1 << 10**9", _BITS),
    ("-(-10**9 << 10**9)", _BITS),
    ("factorial(10**6)", _BITS),
    ("comb(10**6, 10**5)", _BITS),
    ("perm(10**6, 10**5)", _BITS),
    ("lcm(*range(1, 10**5))", _BITS),
    ("prod(range(1, 10**5))", _BITS),
    ("sum([2**99999] * 10**6)", f"{_BITS}|{_LONG}|{_SIZE}"),
    ("int('f' * 900000, 16)", _BITS),
    ("0x" + "f" * 50000, _BITS),
    ("int('9' * 900000)", _DIGITS),
    ("str(10**9999)", _DIGITS),
    ("round(1, -10**9)", "at most 100 digits"),
    ("[factorial(6000) for _ in range(10**5)]", _STEPS),
    ("[gcd(3**40000, 2**45000) for _ in range(10**5)]", _STEPS),
    ("[3**40000 % 7**20000 for _ in range(10**5)]", _STEPS),
    ("[isqrt(3**40000) for _ in range(10**5)]", _STEPS),
    ("[-x for x in [3**49000] for _ in range(10**5)]", _MEMORY),
    ("[x + 1 for x in [3**49000] for _ in range(10**5)]", _MEMORY),
    # Values with shared parts, whose text is exponentially longer.
    (_DOUBLE.format("[1]", "[x, x]", "x"), _SIZE),
    (_DOUBLE.format("[1]", "[x, x]", "x == [x]"), _SIZE),
    (_DOUBLE.format("(1,)", "(x, x)", "{x: 1}"), _SIZE),
    (_DOUBLE.format("(1,)", "(x, x)", "x in [x]"), _SIZE),
    (_DOUBLE.format("(1,)", "(x, x)", "[].index(x)"), _SIZE),
    (_DOUBLE.format("1", "slice(x, x)", "str(x)"), _SIZE),
    (_DOUBLE.format("int", "(x, x)", "isinstance(str, x)"), _SIZE),
    (_DOUBLE.format("[1]", "[x, x]", "'%s' % x"), _SIZE),
    (_DOUBLE.format("[1]", "[x, x]", "f'{x}'"), _SIZE),
    (_DOUBLE.format("[1]", "[x, x]", "sorted([x, x])"), _SIZE),
    ("(lambda h: [h.append(h), h])([1])", _SIZE),
    ("(lambda h: [h.append(h), str(h)])([1])", _SIZE),
    # Slow operations of Python.
    ("[('a' * 500000 + 'b').rfind('c' + 'a' * 250000) for _ in range(1000)]", _STEPS),
    ("('a' * 1000000).strip('b' * 999990 + 'a')", _STEPS),
    ("len({i * (2**61 - 1): 0 for i in range(10**5)})", _STEPS),
    ("len({i * (2**61 - 1) for i in range(10**5)})", _STEPS),
    ("len(dict([(i * (2**61 - 1), 0) for i in range(10**5)]))", _STEPS),
    *(
        (text.format(f"({key} for j in range(50000))"), f"{_STEPS}|{_CPU}|{_MEMORY}")
        for key in _COLLIDING_KEYS
        for text in (
            "len(set({0}))",
            "len(frozenset({0}))",
            "len({{k: 0 for k in {0}}})",
            "len(dict((k, 0) for k in {0}))",
        )
    ),
    *(
        (f"[{use} for x, y in [({_COLLIDING_SETS})] for _ in range(10**6)]", f"{_STEPS}|{_CPU}|{_MEMORY}")
        for use in (
            "x == y",
            "x <= y",
            "x | y",
            "x & y",
            "x.union(y)",
            "x.copy()",
            "set(x)",
            "dict.keys(dict(zip(x, x))) == y",
            "{**dict(zip(x, x))}",
            "[x] == [y]",
            "[x, y].index(y)",
            "y in [x]",
            "sorted([x, y] * 9)",
            "max([x, y] * 9)",
            "(x,) in {(y,)}",
        )
    ),
    ("['\u00e9' * 99999 for _ in [1]][0].translate({233 + i * (2**61 - 1): 'a' for i in range(5000)})", _STEPS),
    ("[x.startswith((y,) * 9999) for x, y in [('a' * 99990 + 'ba', 'a' * 99992)]]", f"{_STEPS}|{_SIZE}"),
    ("[d.keys() | d.keys() for d in [dict(a=1)] for _ in range(10**6)]", f"{_STEPS}|{_MEMORY}"),
    ("{}.keys() | range(10**6)", "cannot be combined"),
    ("[x in range(0, 9, 2**40000) for x in [2**45000] for _ in range(10**6)]", _LONG),
    ("[h.insert(0, 1) for h in [[1] * 900000] for _ in range(90000)]", _STEPS),
    ("[h.count('b') for h in ['a' * 900000] for _ in range(900000)]", _STEPS),
    ("sorted([str(i) * 100 for i in range(20000)] * 40, key=lambda s: s)", f"{_STEPS}|{_MEMORY}"),
    # Nested more deeply than Python's recursion allows.
    *(
        (
            f"(lambda h: [h.append({nested}) for _ in range(40000)] and {use_nested})([(1,)])",
            f"{_DEEP}|{_STEPS}|{_MEMORY}|{_SIZE}",
        )
        for nested, use_nested in [
            ("[h[-1]]", "str(h[-1])"),
            ("[h[-1]]", "h[-1] == [h[-1]]"),
            ("(h[-1],)", "{h[-1]: 1}"),
            ("(h[-1],)", "{(h[-1], 2)}"),
            ("(h[-1],)", "h[-1] in {}"),
            ("(h[-1],)", "isinstance(1, h[-1])"),
            ("{1: h[-1]}", "str(h[-1])"),
            ("{1: h[-1]}", "h[-1] == {1: h[-1]}"),
            ("frozenset([h[-1]])", "{h[-1]}"),
            ("slice(h[-1])", "str(h[-1])"),
            ("(x for x in h[-1])", "list(h[-1])"),
            ("map(str, h[-1])", "list(h[-1])"),
            ("zip(h[-1])", "list(h[-1])"),
            ("enumerate(h[-1])", "list(h[-1])"),
            ("filter(None, h[-1])", "list(h[-1])"),
            ("(lambda f: lambda *a: f(*a))(h[-1])", "h[-1]()"),
        ]
    ),
    # Syntax.
    ("(" * 300 + ")" * 300, "too many nested parentheses|nested too deeply"),
    ("[" * 150 + "]" * 150 + "-" * 5000, "invalid syntax|nested too deeply"),
    ("-" * 50_000 + "1", _DEEP),
    ("1" + "+1" * 30_000, _DEEP),
    ("x+" * 40_000 + "1", "of more than 65536 characters"),
]
_RUN = """
import resource, sys
from pathlib import Path
from tests.base.expressions.names import NAMES, evaluate
from tests.base.expressions.test_bombs import BOMBS
for text, _ in BOMBS:
    try:
        evaluate(text)
        print("no error")
    except Exception as error:
        print(type(error).__name__, " ".join(str(error).split())[:300])
status = Path("/proc/self/status")  # ru_maxrss may be inherited from the parent process
peaks = [line.split()[1] for line in status.read_text().splitlines() if line.startswith("VmHWM")]
print(peaks[0] if peaks else resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""
_MAX_KIB = 250_000


@pytest.mark.slow
def test_bombs_are_refused_in_little_memory() -> None:
    """Each with the whole budget of a document; the timeout is only a safety net."""
    limit = (1 << 30, 1 << 30)
    process = subprocess.run(
        [sys.executable, "-c", _RUN],
        capture_output=True,
        text=True,
        timeout=1200,
        check=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit),
    )
    *results, peak_kib = process.stdout.splitlines()

    pairs = zip(BOMBS, results, strict=True)
    assert [(text, result) for (text, words), result in pairs if not re.search(f"{words}|{_CPU}", result)] == []
    assert int(peak_kib) < _MAX_KIB


@pytest.mark.parametrize(("text", "words"), BOMBS, ids=[text[:60] for text, _ in BOMBS])
def test_a_bomb_is_refused_with_a_message(text: str, words: str) -> None:
    """With a small budget, which is exhausted sooner."""
    with pytest.raises((ExpressionError, SyntaxError, ValueError, TypeError), match=f"{words}|{_STEPS}|{_MEMORY}"):
        Interpreter(Budget(steps=100_000, octets=8_000_000, cpu_s=math.inf)).evaluate(text, NAMES)


@pytest.mark.parametrize(
    "text",
    [
        "[[0] * 100000 for _ in range(400)]",
        "[{1} for _ in range(10**6)]",
        "[(j for j in [1]) for i in range(10**6)]",
        "['%9999d' % 1 for _ in range(10**5)]",
        "[-x for x in [3**49000] for _ in range(10**5)]",
    ],
)
def test_memory_stays_within_twice_the_budget(text: str) -> None:
    """Twice the budget includes temporary values; the budget is reduced because tracing is slow."""
    budget = Budget(octets=4_000_000)
    tracemalloc.start()
    try:
        with pytest.raises(ExpressionError, match="MiB of values"):
            Interpreter(budget).evaluate(text, {"range": range})
        assert tracemalloc.get_traced_memory()[1] < 8_000_000
    finally:
        tracemalloc.stop()


def test_the_expressions_of_a_document_share_their_budget() -> None:
    interpreter = Interpreter(Budget(steps=300_000))

    def exhaust() -> None:
        for _ in range(100):
            interpreter.evaluate("[x for x in range(9999)]", {"range": range})

    with pytest.raises(ExpressionError, match=_STEPS):
        exhaust()


def test_ordinary_work_is_far_below_the_limits() -> None:
    """A description of three hundred links, with a hundred expressions each of about ten operations."""
    interpreter = Interpreter()
    for number in range(300):
        names = {"n": number, "pi": 3.14, "name": "link"}
        for _ in range(50):
            interpreter.evaluate("name + '_' + 'left'", names)
            interpreter.evaluate("-n * 0.5 + pi / 2 - (n - 1) * 0.25", names)
    steps, octets = interpreter.budget.spent
    assert steps < 300_000
    assert octets < 5_000_000
    assert evaluate("sum(x * x for x in range(1000))") == 332833500
