"""`trundle sweep PLAN --row N`: one run again, in the browser or without."""

import sys

from trundle.diagnostics import UsageError
from trundle.page_address import PageAddress
from trundle.physics import SimulationUnstableError
from trundle.spatial import NS_PER_S
from trundle.trials import Plan, Row, Rows

from ..console import say
from ..realtime_pacer import RealtimePacer, shorten_gil_interval
from ..signals import stop_flag
from .launch_trial import LaunchTrialRunner
from .trial import TrialRunner, runner_of

_IDLE_S = 0.02


def replay(plan: Plan, number: int, at: PageAddress | None) -> int:
    """Run a row again and print its values and its result; return the exit code.

    Args:
        plan: as read.
        number: of the row.
        at: address of the page; None: no page.

    Raises:
        TrundleError: there is no such row, or its world cannot be read.
    """
    row, runner = Rows(plan).row(number), runner_of(plan)
    say("\n".join([f"row {number}: seed {row.seed}", *(f"  {name} = {value}" for name, value in row.values.items())]))
    result = runner.run(row)
    measures = [f"  {name} = {value}" for name, value in result.measures.items()]
    say("\n".join([f"{result.status}{f': {result.reason}' if result.reason else ''}", *measures]))
    if at is None:
        return 0 if result.status == "ok" else 1
    if isinstance(runner, LaunchTrialRunner):
        raise UsageError("a row of a launch file has no page yet; run it with --headless")
    return _show(plan, row, runner, at)


def _show(plan: Plan, row: Row, runner: TrialRunner, at: PageAddress) -> int:
    """Simulate a row in real time with a page, which stays after its end, until Ctrl-C."""
    from trundle.sensors import mount_cameras, mount_sensors

    from ..renderers import RENDERERS
    from ..shared_page import SharedPage
    from ..simulation_page.page import SimulationPage

    def warn(text: str) -> None:
        say(text, sys.stderr)
        page.warn(text)

    end_ns = round(plan.duration_s * NS_PER_S)
    with runner.simulation(row) as simulation, stop_flag() as stop:
        simulation.on_reset(simulation.script.restart)
        sensors = (*mount_cameras(simulation, RENDERERS["cpu"]), *mount_sensors(simulation))
        for sensor in sensors:
            sensor.start(simulation)
        with SimulationPage(SharedPage(say=lambda text: say(text, sys.stderr), at=at), simulation, sensors) as page:
            pacer, paused = RealtimePacer(1.0), False
            shorten_gil_interval()
            while not stop.is_set():
                is_over = simulation.script.is_over or simulation.time_ns >= end_ns
                paused = page.handle_requests(pacer, paused=paused or is_over)
                page.update(pacer, paused=paused or is_over)
                if paused or is_over:
                    stop.wait(_IDLE_S)
                    pacer.restart()
                    continue
                try:
                    simulation.advance(min(pacer.next_target(simulation.time_ns), end_ns))
                except SimulationUnstableError as error:
                    warn(str(error))
                    paused = True
    return 0
