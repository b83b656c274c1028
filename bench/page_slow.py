"""A slow page beside another one: pace of the simulation, and messages that the other one gets.

The peer is the same run without the slow page, which reads a third of the poses, in bursts twice a second, and echoes
marks only then, as a browser with two frames a second does.
"""

import statistics
import threading
import time
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
_PAIRS = 7
_SECONDS = 2.0
_BURST, _PAUSE_S = 5, 0.5


def run() -> list[Row]:
    """Alternate runs with and without the slow page."""
    sim = rolling_robots(_ROBOTS, rolling=_ROBOTS)
    with PageServer.start(Session(title="bench", kind="simulation"), at=PageAddress(port=0)) as server:
        page = SimulationPage(SharedPage(say=print, server=server), BareWorld(sim))
        with process(_count, server.url) as other:
            other.recv()
            _measure(sim, page, other)
            pairs = [(_with_slow_page(server.url, sim, page, other), _measure(sim, page, other)) for _ in range(_PAIRS)]
    names = "simulated seconds per second", "messages to another page"
    rows: list[Row] = []
    for i, name in enumerate(names):
        value = statistics.median(slow[i] for slow, _ in pairs)
        ratio = statistics.median(slow[i] / alone[i] for slow, alone in pairs)
        rows.append(Row(f"{_ROBOTS} RP2W and a slow page: {name}", value, "1/s", "the same without it", ratio))
    return rows


def _with_slow_page(url: str, sim: Simulation, page: SimulationPage, other: Connection) -> tuple[float, float]:
    with process(_read_slowly, url) as slow:
        slow.recv()
        return _measure(sim, page, other)


def _measure(sim: Simulation, page: SimulationPage, other: Connection) -> tuple[float, float]:
    """Simulate as fast as possible; return simulated seconds and messages of the other page, each per second."""
    pacer = RealtimePacer(None)
    other.send("count")
    before = int(other.recv())
    began, start_ns = time.monotonic(), sim.time_ns
    while (elapsed := time.monotonic() - began) < _SECONDS:
        sim.run(0.02)
        page.handle_requests(pacer, paused=False)
        page.update(pacer, paused=False)
    other.send("count")
    return (sim.time_ns - start_ns) / 1e9 / elapsed, (int(other.recv()) - before) / elapsed


def _count(pipe: Connection, url: str) -> None:
    """Receive poses; answer each message of the pipe with their number so far."""
    count = 0
    receive = subscribe(url, POSES, 0)

    def receive_all() -> None:
        nonlocal count
        while True:
            receive(1)
            count += 1

    threading.Thread(target=receive_all, daemon=True).start()
    pipe.send("ready")
    while pipe.recv():
        pipe.send(count)


def _read_slowly(pipe: Connection, url: str) -> None:
    receive = subscribe(url, POSES, 0)
    pipe.send("ready")
    while True:
        receive(_BURST)
        time.sleep(_PAUSE_S)
