"""Requests for replays: each is answered, and few are made at a time."""

import threading
from typing import Any

import pytest

from trundle.base.diagnostics import UsageError
from trundle.page import SaveReplay
from trundle.page.replay.recorded_motion import RecordedMotion
from trundle.page.simulated_world import pose_history
from trundle.page.simulated_world.pose_history import ReplaySaver


def _never() -> RecordedMotion:
    raise AssertionError("no poses are copied for what is refused")


def test_pending_replays_are_limited_and_each_is_answered(monkeypatch: pytest.MonkeyPatch) -> None:
    answers: dict[int, Any] = {}
    may_finish = threading.Event()

    def replay_page(*_: object, **__: object) -> str:
        may_finish.wait()
        raise ZeroDivisionError("a world that is not foreseen")

    monkeypatch.setattr(pose_history, "replay_page", replay_page)
    saver = ReplaySaver(lambda number, error=None, **_: answers.update({number: error}))
    motion: Any = None
    saver.save(1, SaveReplay(), lambda: motion)
    saver.save(2, SaveReplay(view="[" * 4000), lambda: motion)
    with pytest.raises(UsageError, match="2 replays are being made already"):
        saver.save(3, SaveReplay(), _never)
    may_finish.set()
    saver._thread.shutdown(wait=True)

    assert answers[1] == "the replay cannot be made: ZeroDivisionError: a world that is not foreseen"
    assert answers[2] is not None
