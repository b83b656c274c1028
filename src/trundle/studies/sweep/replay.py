"""`trundle sweep PLAN --row N`: repetition of one run, optionally in the browser."""

from trundle.base.console import say
from trundle.base.http.page_address import PageAddress

from .launch_row_runner import LaunchRowRunner
from .plan import Plan
from .row_runner import runner_of
from .rows import Rows
from .shown_launch import show_launch
from .shown_world import show_world


def replay(plan: Plan, number: int, at: PageAddress | None) -> int:
    """Run a row again and print its values and result; return the exit code, 130 after Ctrl-C with a page.

    Args:
        plan: plan of the sweep.
        number: row number.
        at: address of the page; None: no page.

    Raises:
        TrundleError: no such row, or its world cannot be read.
    """
    row, runner = Rows(plan).row(number), runner_of(plan)
    say("\n".join([f"row {number}: seed {row.seed}", *(f"  {name} = {value}" for name, value in row.values.items())]))
    result = runner.run(row)
    measures = [f"  {name} = {value}" for name, value in result.measures.items()]
    say("\n".join([f"{result.status}{f': {result.reason}' if result.reason else ''}", *measures]))
    if at is None:
        return 0 if result.status == "ok" else 1
    if isinstance(runner, LaunchRowRunner):
        show_launch(plan, row, runner, at, result)
    else:
        show_world(plan, row, runner, at, result)
    return 130
