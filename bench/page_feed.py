"""A page of fifty rolling robots: CPU time of the simulation's thread with ten clients, one of them stalled.

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
    """Alternate seconds of simulation with and without a page, with a wall clock that advances in real time."""
    sim = rolling_robots(_ROBOTS, rolling=_ROBOTS)
    wall = _WallClock()
    with PageServer.start(Session(title="bench", kind="simulation"), at=PageAddress(port=0)) as server:
        page = SimulationPage(SharedPage(say=print, server=server), BareWorld(sim), wall_ns=wall)
        pacer = RealtimePacer(None)

        def show() -> None:
            page.handle_requests(pacer, paused=False)
            page.update(pacer, paused=False)

        with process(_watch, server.url) as clients:
            clients.recv()
            while not server.is_watched(POSES):
                time.sleep(0.01)
            _cpu_s(sim, wall, show)
            pairs = [(_cpu_s(sim, wall, show), _cpu_s(sim, wall, lambda: None)) for _ in range(_PAIRS)]
    ratio = statistics.median(with_page / alone for with_page, alone in pairs)
    cost_ms = 1e3 * statistics.median(with_page - alone for with_page, alone in pairs) / _SECONDS
    name = f"{_CLIENTS} pages of {_ROBOTS} RP2W rolling, one stalled"
    return [Row(name, cost_ms, "ms/s", "the simulation without", ratio)]


def _watch(pipe: Connection, url: str) -> None:
    """Subscribe to the poses with all clients; the last client does not read."""
    receivers = [subscribe(url, POSES, 0) for _ in range(_CLIENTS)][:-1]
    for receive in receivers:
        threading.Thread(target=receive, args=(10**9,), daemon=True).start()
    pipe.send("ready")
    time.sleep(3600)


class _WallClock:
    """Wall clock that the benchmark sets."""

    def __init__(self) -> None:
        self.now_ns = 0

    def __call__(self) -> int:
        return self.now_ns


def _cpu_s(sim: Simulation, wall: _WallClock, show: Callable[[], None]) -> float:
    """Return the CPU time of this thread for a second of simulation [s]."""
    start = time.thread_time()
    for _ in range(round(_SECONDS / _STRIDE_S)):
        sim.run(_STRIDE_S)
        wall.now_ns += round(_STRIDE_S * 1e9)
        show()
    return time.thread_time() - start
