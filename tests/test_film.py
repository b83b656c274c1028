"""Film and picture of the page, and the clock by which they are made."""

import sys
import threading
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image, ImageSequence
from tests.docs_blocks import ROOT

from trundle.sim.realtime_pacer import RealtimePacer

pytestmark = pytest.mark.skipif(not (ROOT / "docs/generate").is_dir(), reason="no documentation in the sdist")
STRIDE_NS = 20_000_000


def test_the_film_shows_a_robot_that_drives_and_is_small_enough() -> None:
    film = ROOT / "docs/page.webp"
    with Image.open(film) as moving:
        frames = [np.asarray(frame.convert("L")).astype(int) for frame in ImageSequence.all_frames(moving)]
    changes = [np.abs(one - other)[60:330, 200:760].mean() for one, other in pairwise(frames)]

    assert film.stat().st_size < 2_000_000
    assert len(frames) >= 50
    assert frames[0].shape == (600, 960)
    assert sum(change > 0.2 for change in changes) > 0.8 * len(changes), "the scene stands still"


def test_the_picture_is_small_enough() -> None:
    file = ROOT / "docs/page.png"
    with Image.open(file) as picture:
        assert picture.size == (1440, 900)
    assert file.stat().st_size < 300_000


def test_a_simulation_waits_for_each_step_of_the_film_s_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """It goes on by what the clock does, and is one stride ahead when the picture is taken."""
    monkeypatch.setattr(sys, "path", [str(ROOT / "docs"), *sys.path])
    from generate.film_clock import FilmClock

    clock = FilmClock()
    clock.hold()
    pacer = RealtimePacer(1.0, wall_ns=clock.time_ns, sleep=clock.sleep)
    times = [0]

    def simulate() -> None:
        while times[-1] < 6 * STRIDE_NS:
            times.append(pacer.next_target(times[-1]))

    simulation = threading.Thread(target=simulate)
    simulation.start()
    reached = []
    for _ in range(4):
        clock.advance(STRIDE_NS)
        reached.append(times[-1])
    clock.release()
    simulation.join()
    assert reached == [2 * STRIDE_NS, 3 * STRIDE_NS, 4 * STRIDE_NS, 5 * STRIDE_NS]
