"""Time that waits for nodes."""

import threading
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import trundle
from trundle.bringup.gazebo.stepper import GazeboStepper
from trundle.bringup.lockstep import Lockstep
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
    assert said == []  # it did not time out


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
