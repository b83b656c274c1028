"""Time that waits for nodes."""

import threading

from trundle.bringup.in_step import Steps
from trundle.ros import GraphLoop


def test_a_start_that_never_rests_ends_when_asked_to() -> None:
    said: list[str] = []
    ending = threading.Event()
    with GraphLoop() as loop:
        steps = Steps(loop, end_ns=None, recorder=None, say=said.append)
        never_done = loop.work.begin()
        waiting = loop.spawn(steps.let_start(ending.is_set))
        ending.set()
        waiting.result(60.0)
        loop.work.end(never_done)
    assert said == []  # it was not the patience that ended
