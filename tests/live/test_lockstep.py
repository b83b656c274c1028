"""Time that waits for nodes."""

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


def test_a_start_that_never_rests_ends_when_asked_to() -> None:
    said: list[str] = []
    ending = threading.Event()
    with GraphLoop() as loop:
        steps = Lockstep(loop, end_ns=None, recorder=None, say=said.append)
        never_done = loop.work.start()
        waiting = loop.spawn(steps.wait_started(ending.is_set))
        ending.set()
        waiting.result(60.0)
        loop.work.finish(never_done)
    assert said == []  # it was not given up


async def _hold_up(passes: int, seconds: float) -> None:
    """Let each pass of the loop take as long as on a machine with a load of 60."""
    for _ in range(passes):
        time.sleep(seconds)
        await asyncio.sleep(0)


def test_nodes_settle_on_a_machine_where_each_pass_takes_a_quarter_of_a_second() -> None:
    said: list[str] = []
    with GraphLoop() as loop:
        steps = Lockstep(loop, end_ns=None, recorder=None, say=said.append)
        busy = loop.spawn(_hold_up(12, 0.25))
        loop.call_soon(lambda: None)
        steps.wait_settled(lambda: None, lambda: False, lambda: False)
        assert not busy.done()  # it had settled before
    assert said == []


def test_a_node_that_waits_for_a_service_lets_a_slow_machine_start() -> None:
    """It asks the master every 50 ms, in which fifty passes of the loop do not fit there."""
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


def test_what_the_process_does_is_waited_for_and_named(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lockstep, "_ANSWER_S", 0.0)
    monkeypatch.setattr(lockstep, "_ANSWER_PASSES", 0)
    monkeypatch.setattr("trundle.ros.node.loop._CHECK_S", 0.1)
    monkeypatch.setattr("trundle.ros.node.pending_work.PERIOD_S", 0.1)
    said: list[str] = []
    with GraphLoop() as loop:
        steps = Lockstep(loop, end_ns=None, recorder=None, say=said.append)
        reading = loop.work.start("the map")
        answer = loop.work.start("the answer of /slow", is_answer=True)
        threading.Timer(0.5, lambda: loop.work.finish(reading)).start()
        steps.wait_settled(lambda: None, lambda: False, lambda: False)
        loop.work.finish(answer)
    assert said == [
        "the answer of /slow does not come while time is held; time goes on, but another run may differ from this one"
    ]
    assert "waiting for the map; the answer of /slow since " in capfd.readouterr().err


def test_a_world_that_is_reset_amid_a_stretch_goes_on_for_what_was_left(tmp_path: Path) -> None:
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
