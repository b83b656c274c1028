"""Comparison of a row's results with and without a page."""

from collections.abc import Callable

from trundle.base.console import say

from .row_result import RowResult


def report_shown(shown: RowResult, alone: RowResult, warn: Callable[[str], None]) -> None:
    """Print that both results are equal, or warn of the differences.

    Args:
        shown: result with a page.
        alone: result without a page.
        warn: prints a warning.
    """
    if (shown.status, shown.time, shown.measures) == (alone.status, alone.time, alone.measures):
        say("the run shown has the same result, to the byte")
        return
    both = {"status": (shown.status, alone.status), "time": (shown.time, alone.time)}
    both |= {name: (value, alone.measures.get(name)) for name, value in shown.measures.items()}
    differing = [f"{name} = {new} rather than {old}" for name, (new, old) in both.items() if new != old]
    reason = "it was changed on the page, or other programs take part"
    warn(f"the run shown has another result: {'; '.join(differing) or shown.reason} ({reason})")
