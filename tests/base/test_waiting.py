"""Notices of waits without a time limit."""

import time

import pytest

from trundle.base.waiting import WaitNotice


def test_a_long_wait_prints_a_notice_every_ten_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    now_s = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now_s[0])
    lines: list[str] = []

    notice = WaitNotice("the page's server to start", lines.append)
    for second in range(22):
        now_s[0] = 100.0 + second
        notice.poll()

    assert lines == [
        "waiting for the page's server to start since 10 s",
        "waiting for the page's server to start since 20 s",
    ]
