"""Result of a run on the page beside that of the same row without one."""

from collections.abc import Callable

from trundle.base.console import say

from .row_result import RowResult


def report_shown(shown: RowResult, alone: RowResult, warn: Callable[[str], None]) -> None:
    """Print that both are the same, or warn of what differs.

    Args:
        shown: result of the run on the page.
        alone: result without a page.
        warn: prints a line.
    """
    if (shown.status, shown.time, shown.measures) == (alone.status, alone.time, alone.measures):
        say("the run shown has the same result, to the byte")
        return
    both = {"status": (shown.status, alone.status), "time": (shown.time, alone.time)}
    both |= {name: (value, alone.measures.get(name)) for name, value in shown.measures.items()}
    differing = [f"{name} = {here} rather than {there}" for name, (here, there) in both.items() if here != there]
    why = "it was changed on the page, or other programs take part"
    warn(f"the run shown has another result: {'; '.join(differing) or shown.reason} ({why})")
