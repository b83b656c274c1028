"""The tutorials' two robots as a user meets them: one command, and a page in a browser."""

import io
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

pytestmark = [pytest.mark.browser, pytest.mark.slow]

_PATIENCE_S = 120.0


@contextmanager
def _trundle(*words: str, environment: dict[str, str]) -> Iterator[str]:
    """Run a command until its page answers; yields the page's address, then presses Ctrl-C."""
    process = subprocess.Popen(
        [sys.executable, "-m", "trundle", *words],
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
        env={**os.environ, **environment},
        start_new_session=True,
    )
    assert process.stderr is not None
    said = ""
    try:
        for line in process.stderr:
            said += line
            if found := re.search(r"see it at (http://\S+)", line):
                yield found[1]
                os.killpg(process.pid, signal.SIGINT)
                _, rest = process.communicate(timeout=_PATIENCE_S)
                assert "Traceback" not in said + rest
                assert process.returncode == 130
                return
        raise AssertionError(f"no page: {said}")
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()


@contextmanager
def _opened(chromium: Any, url: str) -> Iterator[Any]:
    page = chromium.new_page(viewport={"width": 1200, "height": 900})
    page.set_default_timeout(_PATIENCE_S * 1000)
    page.goto(url)
    yield page
    page.close()


def _blue_columns(page: Any) -> np.ndarray[Any, Any]:
    png = page.screenshot(clip={"x": 310, "y": 0, "width": 560, "height": 900})
    picture = np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=np.int16)
    return np.nonzero((picture[..., 2] > 100) & (picture[..., 0] < 60) & (picture[..., 1] < 60))[1]


def _until(page: Any, reached: Any, what: str) -> None:
    deadline = time.monotonic() + _PATIENCE_S
    while not reached():
        assert time.monotonic() < deadline, what
        page.wait_for_timeout(200)


def test_the_smartcar_is_shown_and_driven_from_the_page(chromium: Any, shared: Path) -> None:
    """The file names an urdf.rviz that was never published: the usual displays, with odom as the fixed frame."""
    words = ("launch", "smartcar_description", "smartcar_display.rviz.launch", "--port", "0", "--view-port", "0")
    with (
        _trundle(*words, environment={"ROS_PACKAGE_PATH": str(shared / "seeds")}) as url,
        _opened(chromium, url) as page,
    ):
        frame = page.get_by_label("Fixed Frame").first
        _until(page, lambda: frame.input_value() == "odom", "odom was not worked out")
        _until(page, lambda: len(_blue_columns(page)) > 100, "the car never appeared")
        standing = _blue_columns(page)

        page.keyboard.down("w")
        _until(page, lambda: _has_left(_blue_columns(page), standing), "the car never moved")
        page.keyboard.up("w")


def _has_left(now: np.ndarray[Any, Any], before: np.ndarray[Any, Any]) -> bool:
    """True if the car is elsewhere in the picture, or out of it."""
    return len(now) < len(before) / 4 or bool(abs(now.mean() - before.mean()) > 40)


def test_the_rp2w_runs_with_both_cameras_and_its_world_on_the_page(chromium: Any, shared: Path) -> None:
    with (
        _trundle("run", str(shared / "seeds" / "rp2w"), "--no-ros", "--port", "0", environment={}) as url,
        _opened(chromium, url) as page,
    ):
        for text in ("netbook_webcam", "my_sensor", "ground_plane"):
            page.get_by_text(text).first.wait_for()
        fetched = "performance.getEntriesByType('resource').some(entry => entry.name.endsWith('.glb'))"
        _until(page, lambda: page.evaluate(fetched), "no GLB was asked for")

        page.get_by_role("button", name="Pause", exact=True).first.click()

        page.get_by_role("button", name="Play", exact=True).first.wait_for()
