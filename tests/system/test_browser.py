"""The tutorials' two robots, each with one command and its page in a browser."""

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.system.browser import opened, running_page, until

pytestmark = [pytest.mark.browser, pytest.mark.slow]


def _blue_columns(page: Any) -> np.ndarray[Any, Any]:
    png = page.screenshot(clip={"x": 310, "y": 0, "width": 560, "height": 900})
    picture = np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=np.int16)
    return np.nonzero((picture[..., 2] > 100) & (picture[..., 0] < 60) & (picture[..., 1] < 60))[1]


def test_the_smartcar_is_drawn_and_driven_on_the_page(chromium: Any, shared: Path) -> None:
    """The file refers to an unpublished urdf.rviz: the default displays are used, with odom as the fixed frame."""
    words = ("launch", "smartcar_description", "smartcar_display.rviz.launch", "--port", "0", "--view-port", "0")
    with (
        running_page(*words, environment={"ROS_PACKAGE_PATH": str(shared / "seeds")}) as url,
        opened(chromium, url) as page,
    ):
        frame = page.get_by_label("Fixed Frame").first
        until(page, lambda: frame.input_value() == "odom", "odom was not worked out")
        until(page, lambda: len(_blue_columns(page)) > 100, "the car never appeared")
        before = _blue_columns(page)

        page.keyboard.down("w")
        until(page, lambda: _has_moved(_blue_columns(page), before), "the car never moved")
        page.keyboard.up("w")


def _has_moved(now: np.ndarray[Any, Any], before: np.ndarray[Any, Any]) -> bool:
    """Return whether the car has moved in the picture, or out of it."""
    return len(now) < len(before) / 4 or bool(abs(now.mean() - before.mean()) > 40)


def test_the_page_shows_the_rp2w_with_both_cameras(chromium: Any, shared: Path) -> None:
    with (
        running_page("run", str(shared / "seeds" / "rp2w"), "--no-ros", "--port", "0", environment={}) as url,
        opened(chromium, url) as page,
    ):
        for text in ("netbook_webcam", "my_sensor", "ground_plane"):
            page.get_by_text(text).first.wait_for()
        fetched = "performance.getEntriesByType('resource').some(entry => entry.name.endsWith('.glb'))"
        until(page, lambda: page.evaluate(fetched), "no GLB was asked for")

        page.get_by_role("button", name="Pause", exact=True).first.click()

        page.get_by_role("button", name="Play", exact=True).first.wait_for()
