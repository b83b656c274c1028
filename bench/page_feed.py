"""The page beside fifty rolling robots: CPU of the simulation's thread with ten clients, one of them stalled.

The peer is the same run without a page.
"""

import statistics
import threading
import time
from collections.abc import Callable
from multiprocessing.connection import Connection

from bench.page import process, subscribe
from bench.robots import rolling_robots
from bench.table import Row
from trundle.base.http.page_address import PageAddress
from trundle.page import POSES, PageServer, Session
from trundle.page.shared_page import SharedPage
from trundle.page.shown_world import BareWorld
from trundle.page.simulated_world.page import SimulationPage
from trundle.sim.realtime_pacer import RealtimePacer
from trundle.sim.simulation import Simulation

_ROBOTS = 50
_CLIENTS = 10
_PAIRS = 9
_SECONDS = 1.0
_STRIDE_S = 0.02


def run() -> list[Row]:
    """Alternate seconds with a page and without, in simulation time as in a run in real time."""
    sim = rolling_robots(_ROBOTS, rolling=_ROBOTS)
    wall = _Wall()
    with PageServer.start(Session(title="bench", kind="simulation"), at=PageAddress(port=0)) as server:
        page = SimulationPage(SharedPage(say=print, server=server), BareWorld(sim), wall_ns=wall)
        pacer = RealtimePacer(None)

        def show() -> None:
            page.handle_requests(pacer, paused=False)
            page.update(pacer, paused=False)

        with process(_look, server.url) as clients:
            clients.recv()
            while not server.is_watched(POSES):
                time.sleep(0.01)
            _cpu_s(sim, wall, show)
            pairs = [(_cpu_s(sim, wall, show), _cpu_s(sim, wall, lambda: None)) for _ in range(_PAIRS)]
    ratio = statistics.median(shown / alone for shown, alone in pairs)
    cost_ms = 1e3 * statistics.median(shown - alone for shown, alone in pairs) / _SECONDS
    name = f"{_CLIENTS} pages of {_ROBOTS} RP2W rolling, one stalled"
    return [Row(name, cost_ms, "ms/s", "the simulation without", ratio)]


def _look(pipe: Connection, url: str) -> None:
    """Watch the poses with all clients, of which the last one stops reading."""
    reading = [subscribe(url, POSES, 0) for _ in range(_CLIENTS)][:-1]
    for receive in reading:
        threading.Thread(target=receive, args=(10**9,), daemon=True).start()
    pipe.send("ready")
    time.sleep(3600)


class _Wall:
    """Wall time of a run in real time."""

    def __init__(self) -> None:
        self.now_ns = 0

    def __call__(self) -> int:
        return self.now_ns


def _cpu_s(sim: Simulation, wall: _Wall, show: Callable[[], None]) -> float:
    """CPU time of this thread for a second of simulation [s]."""
    start = time.thread_time()
    for _ in range(round(_SECONDS / _STRIDE_S)):
        sim.run(_STRIDE_S)
        wall.now_ns += round(_STRIDE_S * 1e9)
        show()
    return time.thread_time() - start
