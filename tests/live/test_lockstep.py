"""Lockstep: time that waits for nodes."""

import asyncio
import threading
import time
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from tests.graphs import PATIENCE_S, running_graph

import trundle
from trundle.live import lockstep
from trundle.live.gazebo.stepper import GazeboStepper
from trundle.live.lockstep import Lockstep
from trundle.ros import GraphLoop


def test_wait_started_ends_on_request() -> None:
    lines: list[str] = []
    ending = threading.Event()
    with GraphLoop() as loop:
        steps = Lockstep(loop, end_ns=None, recorder=None, say=lines.append)
        never_done = loop.work.start()
        waiting = loop.spawn(steps.wait_started(ending.is_set))
        ending.set()
        waiting.result(60.0)
        loop.work.finish(never_done)
    assert lines == []  # it was not given up


async def _hold_up(passes: int, seconds: float) -> None:
    """Slow down each pass of the loop, as on a machine with a load of 60."""
    for _ in range(passes):
        time.sleep(seconds)
        await asyncio.sleep(0)


def test_nodes_settle_on_a_machine_where_each_pass_takes_a_quarter_of_a_second() -> None:
    lines: list[str] = []
    with GraphLoop() as loop:
        steps = Lockstep(loop, end_ns=None, recorder=None, say=lines.append)
        busy = loop.spawn(_hold_up(12, 0.25))
        loop.call_soon(lambda: None)
        steps.wait_settled(lambda: None, lambda: False, lambda: False)
        assert not busy.done()  # it had settled before
    assert lines == []


def test_waiting_for_a_service_does_not_block_the_start_on_a_slow_machine() -> None:
    """It polls the master every 50 ms, in which a slow machine does not make fifty passes of the loop."""
    with running_graph() as graph:
        steps = Lockstep(graph.loop, end_ns=None, recorder=None, say=lambda _: None)
        node = graph.node("n")
        waiting = graph.loop.spawn(node.wait_for_service("/not_there"))
        slow = graph.loop.spawn(_hold_up(10_000, 0.005))
        graph.ready(node)

        graph.loop.run(steps.wait_started(lambda: False), PATIENCE_S)

        assert not slow.done()
        waiting.cancel()
        slow.cancel()


def test_own_work_is_awaited_and_named_but_answers_time_out(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lockstep, "_ANSWER_S", 0.0)
    monkeypatch.setattr(lockstep, "_ANSWER_PASSES", 0)
    monkeypatch.setattr("trundle.ros.node.loop._CHECK_S", 0.1)
    monkeypatch.setattr("trundle.ros.node.pending_work.PERIOD_S", 0.1)
    lines: list[str] = []
    with GraphLoop() as loop:
        steps = Lockstep(loop, end_ns=None, recorder=None, say=lines.append)
        reading = loop.work.start("the map")
        answer = loop.work.start("the answer of /slow", is_answer=True)
        threading.Timer(0.5, lambda: loop.work.finish(reading)).start()
        steps.wait_settled(lambda: None, lambda: False, lambda: False)
        loop.work.finish(answer)
    assert lines == [
        "the answer of /slow does not arrive while time is held; time advances, "
        "but another run may differ from this one"
    ]
    assert "waiting for the map; the answer of /slow since " in capfd.readouterr().err


def test_a_reset_during_a_stride_keeps_its_remaining_time(tmp_path: Path) -> None:
    file = tmp_path / "w.sdf"
    file.write_text('<sdf version="1.6"><world name="w"/></sdf>')
    sim = trundle.load(str(file))
    sim.run(0.5)
    times: list[int] = []
    calls = SimpleNamespace(run_pending=lambda: None, has_pending=lambda: False)
    world = SimpleNamespace(
        paused=False, _ending=threading.Event(), _calls=calls, clock=SimpleNamespace(set=times.append)
    )

    sim.post(lambda sim: sim.reset())
    steps = SimpleNamespace(wait_settled=lambda *_: None, record_step=lambda _: None, over=threading.Event())
    GazeboStepper._step_lockstep(cast(GazeboStepper, world), sim, cast(Lockstep, steps), sim.time_ns + 20_000_000)

    assert (sim.time_ns, times) == (20_000_000, [20_000_000])
