"""Row of a world in the browser, in real time."""

import sys

from trundle.base.console import say
from trundle.base.http.page_address import PageAddress
from trundle.base.signals import stop_flag
from trundle.page.shared_page import SharedPage
from trundle.page.simulated_world.page import SimulationPage
from trundle.sim.physics import SimulationUnstableError
from trundle.sim.realtime_pacer import RealtimePacer, shorten_gil_interval
from trundle.spatial import NS_PER_S

from .plan import Plan
from .row_result import RowResult
from .row_runner import RowRunner
from .rows import Row
from .shown_result import report_shown

_IDLE_S = 0.02


def show_world(plan: Plan, row: Row, runner: RowRunner, at: PageAddress, result: RowResult) -> None:
    """Simulate a row once a browser shows it, and serve the page until Ctrl-C.

    Args:
        plan: plan of the sweep.
        row: row to simulate.
        runner: runner of the plan.
        at: address of the page.
        result: result of the same row without a page, for comparison.

    Raises:
        UsageError: the port is in use.
    """

    def warn(text: str) -> None:
        say(text, sys.stderr)
        page.warn(text)

    shared = SharedPage(say=lambda text: say(text, sys.stderr), at=at)
    end_ns, is_reported = round(plan.duration_s * NS_PER_S), False
    with runner.start(row) as run, stop_flag() as stop:
        simulation = run.simulation
        simulation.on_reset(run.script.restart)
        simulation.live.start_sensors()
        with SimulationPage(shared, simulation.live) as page:
            pacer, paused, is_seen = RealtimePacer(1.0), False, False
            shorten_gil_interval()
            while not stop.is_set():
                is_seen = is_seen or page.is_watched
                is_over = run.script.is_over or simulation.time_ns >= end_ns
                if is_over and not is_reported:
                    is_reported = True
                    report_shown(runner.result(row, run), result, warn)
                paused = page.handle_requests(pacer, paused=paused or is_over)
                page.update(pacer, paused=paused or is_over)
                if paused or is_over or not is_seen:
                    stop.wait(_IDLE_S)
                    pacer.restart()
                    continue
                try:
                    run.advance(min(pacer.next_target(simulation.time_ns), end_ns))
                except SimulationUnstableError as error:
                    warn(str(error))
                    paused = True
