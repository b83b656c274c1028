"""A row of a sweep over a launch file, shown in the browser in real time and in lockstep with its nodes."""

from trundle.base.console import say
from trundle.base.http.page_address import PageAddress
from trundle.base.signals import stop_flag
from trundle.live.launch.options import LaunchOptions
from trundle.page import POSES
from trundle.spatial import NS_PER_S

from .launch_row_runner import LaunchRowRunner, check_running
from .plan import Plan
from .row_result import RowResult
from .rows import Row
from .shown_result import report_shown

_POLL_S = 0.02


def show_launch(plan: Plan, row: Row, runner: LaunchRowRunner, at: PageAddress, result: RowResult) -> None:
    """Launch a row, start its time when a browser shows it, and serve the page until Ctrl-C.

    Args:
        plan: plan of the sweep.
        row: row to launch.
        runner: runner of the plan.
        at: address of the page.
        result: result of the same row without a page, for comparison.

    Raises:
        TrundleError: the launch has no world, or the port is in use.
    """
    options = LaunchOptions(
        duration_s=plan.duration_s,
        in_step=True,
        host=at.host,
        view_port=at.port,
        allowed=at.allowed,
        view_only=at.view_only,
    )
    end_ns, has_begun, is_reported = round(plan.duration_s * NS_PER_S), False, False
    with stop_flag() as stop, runner.session(row, options) as (session, setup):
        page = session.show_world()
        running = session.start(session.nodes, is_ending=stop.is_set, begins=False)
        while not stop.wait(_POLL_S):
            check_running(running)
            if not has_begun and page.is_watched(POSES):
                has_begun = True
                session.begin()
            if not session.is_over:
                continue
            if not is_reported:
                is_reported = True
                report_shown(runner.result(row, setup), result, say)
            if not setup.is_over and setup.simulation.time_ns < end_ns:  # the simulation was reset
                session.rewind()
