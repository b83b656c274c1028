"""The pace of sending, over simulated connections and to simulated clients."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import pytest

from trundle.page.clients.pace import Pace

STEP_S = 0.001
WARM_UP_S = 3.0
MARK_BYTES = 20


@dataclass
class Client:
    """A client behind a connection that holds any amount of data."""

    rate: Callable[[float], float]
    """Bytes per second at a time [s]."""
    way_s: float = 0.001
    """Time of each way."""
    period_s: float = STEP_S
    """Period at which data arrive."""
    busy_s: float = 0.0
    """Part of each half second in which the client handles nothing."""


@dataclass
class Figures:
    """What a client received after the warm-up."""

    lags: list[float]
    """Age of each message when it was handled [s]."""
    newest: list[float]
    """Age of the newest message at the end of each half second in which something was handled [s]."""
    bytes_per_s: float


def _simulate(client: Client, *, demand: float, message: int = 2000, seconds: float = 20.0) -> Figures:
    """Send a stream whose messages replace unsent ones; `demand` is what it has [bytes/s]."""
    pace = Pace()
    way: deque[tuple[int, float, int | None]] = deque()
    arrived: deque[tuple[float, float, int | None]] = deque()
    echoes: deque[tuple[float, int]] = deque()
    lags: list[float] = []
    newest: dict[int, float] = {}
    queued_s: float | None = None
    due = ready = 0.0
    for step in range(1, int(seconds / STEP_S)):
        now = step * STEP_S
        due += demand * STEP_S
        if due >= message:
            due, queued_s = due - message, now
        if queued_s is not None and pace.wait_s(now) <= 0.0:
            pace.add(message)
            way.append((message, queued_s, None))
            queued_s = None
        if (mark := pace.mark(now, is_limited=queued_s is not None)) is not None:
            way.append((MARK_BYTES, now, mark))
        ready += client.rate(now) * STEP_S
        if int(now / client.period_s) != int((now - STEP_S) / client.period_s):
            while way and way[0][0] <= ready:
                size, sent_s, number = way.popleft()
                ready -= size
                arrived.append((now + client.way_s, sent_s, number))
            ready = ready if way else 0.0
        if now % 0.5 >= client.busy_s:
            while arrived and arrived[0][0] <= now:
                _, sent_s, number = arrived.popleft()
                if number is not None:
                    echoes.append((now + client.way_s, number))
                elif now > WARM_UP_S:
                    lags.append(now - sent_s)
                    newest[int(now / 0.5)] = now - sent_s
        while echoes and echoes[0][0] <= now:
            pace.echo(echoes.popleft()[1], now)
    return Figures(sorted(lags), sorted(newest.values()), len(lags) * message / (seconds - WARM_UP_S))


SLOW = {
    "at once": Client(lambda _: 100e3),
    "a far one": Client(lambda _: 100e3, way_s=0.025),
    "in bursts": Client(lambda _: 100e3, period_s=0.1),
    "a faster one": Client(lambda _: 1e6),
}


@pytest.mark.parametrize("name", SLOW)
def test_little_waits_on_a_slow_connection_that_is_used_fully(name: str) -> None:
    client = SLOW[name]

    figures = _simulate(client, demand=4 * client.rate(0.0))

    assert figures.lags[int(0.99 * len(figures.lags))] < 0.3
    assert figures.lags[-1] < 0.4
    assert figures.bytes_per_s > 0.8 * client.rate(0.0)


@pytest.mark.parametrize("way_s", [0.001, 0.05])
def test_a_fast_connection_gets_everything_at_once(way_s: float) -> None:
    figures = _simulate(Client(lambda _: 100e6, way_s=way_s), demand=2e6)

    assert figures.lags[-1] < way_s + 0.01
    assert figures.bytes_per_s > 0.95 * 2e6


@pytest.mark.parametrize("busy_s", [0.25, 0.45])
def test_a_busy_client_has_fresh_messages_whenever_it_reads(busy_s: float) -> None:
    """Two frames a second: what waits until a frame is over is no reason to send less."""
    figures = _simulate(Client(lambda _: 100e6, busy_s=busy_s), demand=400e3)

    assert figures.newest[-1] < 0.05
    assert figures.bytes_per_s > 0.8 * 400e3


def test_what_a_slow_and_busy_client_reads_is_fresh() -> None:
    """Also, a browser whose few free moments do not suffice for all messages."""
    figures = _simulate(Client(lambda _: 100e3, busy_s=0.45), demand=400e3)

    assert figures.newest[len(figures.newest) // 2] < 0.3
    assert figures.bytes_per_s > 0.7 * 100e3


def test_a_connection_that_becomes_slow_is_fresh_again_soon_and_fast_again_later() -> None:
    slow = Client(lambda now: 100e3 if 10.0 < now < 20.0 else 2e6)

    figures = _simulate(slow, demand=1e6, seconds=40.0)

    late = [lag for lag in figures.lags if lag > 0.3]
    assert len(late) < 0.02 * len(figures.lags)
    assert figures.bytes_per_s > 0.6 * 1e6


def test_nothing_is_sent_to_a_client_that_stops_to_read() -> None:
    pace = Pace()
    now = 0.0
    for _ in range(100):
        now += 0.01
        assert pace.wait_s(now) == 0.0
        pace.add(100)
        mark = pace.mark(now, is_limited=False)
        if mark is not None:
            pace.echo(mark, now)
    sent = 0
    while now < 10.0:
        now += 0.01
        if pace.wait_s(now) == 0.0:
            pace.add(1000)
            sent += 1000
        pace.mark(now, is_limited=True)

    assert 0 < sent < 50_000
    assert pace.wait_s(now) == float("inf")


def test_a_client_that_echoes_nothing_is_not_paced() -> None:
    """Every WebSocket answers pings, but for those that do not."""
    pace = Pace()
    pace.add(100_000)
    pace.mark(0.0, is_limited=True)

    assert pace.wait_s(1.0) == float("inf")
    assert pace.wait_s(6.0) == 0.0
    assert pace.budget(6.0) == float("inf")


def test_an_idle_connection_is_not_taken_for_a_slow_one() -> None:
    pace = Pace()
    pace.add(100)
    for second in range(60):
        mark = pace.mark_now(float(second))
        pace.echo(mark, second + 0.001)

    assert pace.transfer_s(64_000) == 1.0
    assert pace.wait_s(60.0) == 0.0


@pytest.mark.parametrize("number", [0, -1, 2, 10**9])
def test_echoes_of_marks_that_were_not_sent_are_ignored(number: int) -> None:
    pace = Pace()
    pace.add(100)
    assert pace.mark(0.0, is_limited=False) == 1

    pace.echo(number, 1.0)

    assert not pace.is_known
    pace.echo(1, 1.0)
    assert pace.is_known
    pace.echo(1, 1.0)
