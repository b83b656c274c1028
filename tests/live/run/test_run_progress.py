"""Progress of a headless run in a terminal."""

from trundle.live.run.run_world import RunProgress


def test_progress_prints_time_and_speed_every_five_seconds() -> None:
    lines: list[str] = []
    clock = [0.0]
    progress = RunProgress(lines.append, end_ns=60_000_000_000, now=lambda: clock[0])
    for wall, simulated_s in ((0.0, 0.0), (4.9, 9.8), (5.0, 10.0), (9.0, 12.0), (10.0, 12.5)):
        clock[0] = wall
        progress.update(round(simulated_s * 1e9))

    assert lines == [
        "10.0 of 60 s simulated, 2 times real time; Ctrl-C ends it",
        "12.5 of 60 s simulated, 0.5 times real time; Ctrl-C ends it",
    ]


def test_a_reset_restarts_the_count() -> None:
    lines: list[str] = []
    clock = [0.0]
    progress = RunProgress(lines.append, end_ns=None, now=lambda: clock[0])
    for wall, simulated_s in ((0.0, 50.0), (6.0, 1.0), (12.0, 7.0)):
        clock[0] = wall
        progress.update(round(simulated_s * 1e9))

    assert lines == ["7.0 s simulated, 1 times real time; Ctrl-C ends it"]
