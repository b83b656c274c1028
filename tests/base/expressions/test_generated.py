"""Generated expressions end soon and in little memory, with a value or a message."""

import contextlib
import math
import resource
import subprocess
import sys
import tracemalloc
from collections.abc import Iterator

import pytest
from tests.base.expressions.generated import generated_expression, names

from trundle.base.expressions import Budget, Interpreter

_ERRORS = (ValueError, TypeError, LookupError, ArithmeticError, AttributeError, NameError, SyntaxError, RuntimeError)
_OCTETS = 2_000_000
_MEASURE = """
import sys, time
from tests.base.expressions.generated import generated_expression, names
from trundle.base.expressions import Budget, Interpreter
values = names()  # before the first measurement, as it takes seconds
for number in range(int(sys.argv[1]), int(sys.argv[2])):
    text, start_s = generated_expression(number), time.thread_time()
    try:
        Interpreter(Budget(steps=60_000, octets=2_000_000, cpu_s=0.03)).evaluate(text, values)
    except Exception as error:
        str(error)
    print(f"{time.thread_time() - start_s:.3f} {text}")
with open("/proc/self/status") as status:
    print(next((line.split()[1] for line in status if line.startswith("VmHWM")), "0"))
"""


@pytest.fixture(autouse=True, scope="module")
def _free_values() -> Iterator[None]:
    """Free the values, about 100 MB."""
    yield
    names.cache_clear()


@pytest.mark.parametrize("first", range(0, 400, 100))
def test_generated_expressions_end_with_a_value_or_a_message(first: int) -> None:
    """Without the time limit, so that only the budget of steps ends them."""
    for number in range(first, first + 100):
        with contextlib.suppress(*_ERRORS):
            Interpreter(Budget(steps=20_000, octets=_OCTETS, cpu_s=math.inf)).evaluate(
                generated_expression(number), names()
            )


def test_memory_stays_within_twice_the_budget() -> None:
    """Twice the budget includes temporary values; it is a fiftieth of the usual one, because tracing is slow."""
    tracemalloc.start()
    try:
        for number in range(1000, 1100):
            tracemalloc.reset_peak()
            before, _ = tracemalloc.get_traced_memory()
            with contextlib.suppress(*_ERRORS):
                Interpreter(Budget(steps=20_000, octets=_OCTETS, cpu_s=math.inf)).evaluate(
                    generated_expression(number), names()
                )
            assert tracemalloc.get_traced_memory()[1] - before < 2 * _OCTETS + 10 * 2**20, generated_expression(number)
    finally:
        tracemalloc.stop()


def test_the_processor_time_limit_ends_long_evaluations() -> None:
    interpreter = Interpreter(Budget(steps=10**9, octets=10**9, cpu_s=0.05))
    with pytest.raises(ValueError, match=r"the expressions of one file may take at most 0\.05 s of the processor"):
        interpreter.evaluate("[x for x in range(10**6) for y in range(10**6) if False]", names())
    with pytest.raises(ValueError, match="of the processor"):
        interpreter.evaluate("sum(range(10000))", names())


def test_processor_time_between_evaluations_does_not_count() -> None:
    interpreter = Interpreter(Budget(cpu_s=0.2))
    assert interpreter.evaluate("1 + 1", names()) == 2
    sum(1 for _ in range(5_000_000))
    assert interpreter.evaluate("sum(range(3000))", names()) == 4498500


@pytest.mark.slow
def test_ten_thousand_expressions_end_within_half_a_second_each() -> None:
    """A fiftieth of the usual budget, so that a single long operation stands out."""
    limit = (1 << 30, 1 << 30)
    words = [sys.executable, "-c", _MEASURE, "10000", "20000"]
    process = subprocess.run(
        words,
        capture_output=True,
        text=True,
        timeout=3000,
        check=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit),
    )
    *measured, peak_kib = process.stdout.splitlines()

    assert len(measured) == 10_000
    assert [line for line in measured if float(line.split()[0]) > 0.5] == []
    assert int(peak_kib) < 200_000
