"""Made-up expressions end soon and in little memory, in a value or a sentence."""

import contextlib
import math
import resource
import subprocess
import sys
import tracemalloc
from collections.abc import Iterator

import pytest
from tests.base.expressions.made_up import made_up, names

from trundle.base.expressions import Budget, Interpreter

_ENDINGS = (ValueError, TypeError, LookupError, ArithmeticError, AttributeError, NameError, SyntaxError, RuntimeError)
_OCTETS = 2_000_000
_MEASURE = """
import sys, time
from tests.base.expressions.made_up import made_up, names
from trundle.base.expressions import Budget, Interpreter
values = names()  # seconds of the processor, which were measured as the first expression's
for number in range(int(sys.argv[1]), int(sys.argv[2])):
    text, start_s = made_up(number), time.thread_time()
    try:
        Interpreter(Budget(steps=60_000, octets=2_000_000, cpu_s=0.03)).evaluate(text, values)
    except Exception as error:
        str(error)
    print(f"{time.thread_time() - start_s:.3f} {text}")
with open("/proc/self/status") as status:
    print(next((line.split()[1] for line in status if line.startswith("VmHWM")), "0"))
"""


@pytest.fixture(autouse=True, scope="module")
def _forget() -> Iterator[None]:
    """Free the values, some 100 MB."""
    yield
    names.cache_clear()


@pytest.mark.parametrize("first", range(0, 400, 100))
def test_any_expression_ends_in_a_value_or_a_sentence(first: int) -> None:
    """Without the clock, so that the budget of steps alone ends them."""
    for number in range(first, first + 100):
        with contextlib.suppress(*_ENDINGS):
            Interpreter(Budget(steps=20_000, octets=_OCTETS, cpu_s=math.inf)).evaluate(made_up(number), names())


def test_any_expression_takes_the_memory_that_its_budget_allows() -> None:
    """Twice that includes temporary values; a fiftieth of the usual budget, because tracing is slow."""
    tracemalloc.start()
    try:
        for number in range(1000, 1100):
            tracemalloc.reset_peak()
            before, _ = tracemalloc.get_traced_memory()
            with contextlib.suppress(*_ENDINGS):
                Interpreter(Budget(steps=20_000, octets=_OCTETS, cpu_s=math.inf)).evaluate(made_up(number), names())
            assert tracemalloc.get_traced_memory()[1] - before < 2 * _OCTETS + 10 * 2**20, made_up(number)
    finally:
        tracemalloc.stop()


def test_the_clock_ends_what_the_steps_would_allow() -> None:
    interpreter = Interpreter(Budget(steps=10**9, octets=10**9, cpu_s=0.05))
    with pytest.raises(ValueError, match=r"the expressions of one file may take at most 0\.05 s of the processor"):
        interpreter.evaluate("[x for x in range(10**6) for y in range(10**6) if False]", names())
    with pytest.raises(ValueError, match="of the processor"):
        interpreter.evaluate("sum(range(10000))", names())


def test_the_clock_stands_still_between_evaluations() -> None:
    interpreter = Interpreter(Budget(cpu_s=0.2))
    assert interpreter.evaluate("1 + 1", names()) == 2
    sum(1 for _ in range(5_000_000))
    assert interpreter.evaluate("sum(range(3000))", names()) == 4498500


@pytest.mark.slow
def test_ten_thousand_expressions_end_within_half_a_second_each() -> None:
    """A fiftieth of the usual budget, which leaves one long operation nothing to hide behind."""
    limit = (1 << 30, 1 << 30)
    words = [sys.executable, "-c", _MEASURE, "10000", "20000"]
    ended = subprocess.run(
        words,
        capture_output=True,
        text=True,
        timeout=3000,
        check=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit),
    )
    *measured, peak_kib = ended.stdout.splitlines()

    assert len(measured) == 10_000
    assert [line for line in measured if float(line.split()[0]) > 0.5] == []
    assert int(peak_kib) < 200_000
