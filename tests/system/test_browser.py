"""The tutorials' two robots as a user meets them: one command, and a page in a browser."""

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


def test_the_smartcar_is_shown_and_driven_from_the_page(chromium: Any, shared: Path) -> None:
    """The file names an urdf.rviz that was never published: the usual displays, with odom as the fixed frame."""
    words = ("launch", "smartcar_description", "smartcar_display.rviz.launch", "--port", "0", "--view-port", "0")
    with (
        running_page(*words, environment={"ROS_PACKAGE_PATH": str(shared / "seeds")}) as url,
        opened(chromium, url) as page,
    ):
        frame = page.get_by_label("Fixed Frame").first
        until(page, lambda: frame.input_value() == "odom", "odom was not worked out")
        until(page, lambda: len(_blue_columns(page)) > 100, "the car never appeared")
        standing = _blue_columns(page)

        page.keyboard.down("w")
        until(page, lambda: _has_left(_blue_columns(page), standing), "the car never moved")
        page.keyboard.up("w")


def _has_left(now: np.ndarray[Any, Any], before: np.ndarray[Any, Any]) -> bool:
    """True if the car is elsewhere in the picture, or out of it."""
    return len(now) < len(before) / 4 or bool(abs(now.mean() - before.mean()) > 40)


def test_the_rp2w_runs_with_both_cameras_and_its_world_on_the_page(chromium: Any, shared: Path) -> None:
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
