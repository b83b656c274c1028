"""Video and picture of the page, and the clock of their recording."""

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


def test_the_video_shows_a_moving_robot_and_is_small() -> None:
    film = ROOT / "docs/page.webp"
    with Image.open(film) as image:
        frames = [np.asarray(frame.convert("L")).astype(int) for frame in ImageSequence.all_frames(image)]
    changes = [np.abs(one - other)[60:330, 200:760].mean() for one, other in pairwise(frames)]

    assert film.stat().st_size < 2_000_000
    assert len(frames) >= 50
    assert frames[0].shape == (600, 960)
    assert sum(change > 0.2 for change in changes) > 0.8 * len(changes), "the scene does not move"


def test_the_picture_is_small() -> None:
    file = ROOT / "docs/page.png"
    with Image.open(file) as picture:
        assert picture.size == (1440, 900)
    assert file.stat().st_size < 300_000


def test_a_film_paces_the_run_by_its_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """It replaces the pacer in the module that runs the simulation."""
    monkeypatch.setattr(sys, "path", [str(ROOT / "docs"), *sys.path])
    from generate import film

    assert film.run_module.RealtimePacer is RealtimePacer
    assert callable(film.run_module.run)


def test_a_simulation_follows_the_steps_of_the_film_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """It advances with the clock, and is one stride ahead when a picture is taken."""
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
