"""Waits without a time limit say what they wait for."""

import pytest

from trundle.base import waiting
from trundle.base.waiting import WaitNotice


def test_a_long_wait_says_every_few_seconds_what_it_is_for(monkeypatch: pytest.MonkeyPatch) -> None:
    now_s = [100.0]
    monkeypatch.setattr(waiting.time, "monotonic", lambda: now_s[0])
    lines: list[str] = []

    notice = WaitNotice("the page's server to start", lines.append)
    for second in range(22):
        now_s[0] = 100.0 + second
        notice.poll()

    assert lines == [
        "waiting for the page's server to start since 10 s",
        "waiting for the page's server to start since 20 s",
    ]
