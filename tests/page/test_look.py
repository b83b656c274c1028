"""Comparison with the design's drawing: a phone's disc while it is held, dark and light."""

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from tests.graphs import running_graph
from tests.page.built_client import needs_client

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

pytestmark = [pytest.mark.slow, needs_client]

OUT = Path(__file__).parents[2] / "out" / "look"
PHONE = {"width": 390, "height": 844}
DISC_PX = 148
FACE_PX = 70
"""Radius of the opaque part of the disc [px]."""
KNOB = (-5.0, -27.0)
"""Position of the drawn knob from the middle [px]."""
PATIENCE_MS = 60_000
_LIKE = 24
"""Limit of differences of equal colors, as glass shows some of its background."""


@pytest.fixture(scope="module")
def url() -> Iterator[str]:
    with running_graph() as graph:
        robot = graph.node("robot")
        robot.subscribe("/cmd_vel", "geometry_msgs/Twist", lambda _: None)
        session = Session(title="t", kind="graph", drive_topic="/cmd_vel")
        with PageServer.start(session, at=PageAddress(port=0), graph=GraphAddress(master_uri=graph.core.uri)) as server:
            yield server.url


def _around(tab: Any, middle: tuple[float, float]) -> NDArray[np.int16]:
    """Return the pixels (148, 148, 3) around a point."""
    half = DISC_PX / 2
    clip = {"x": middle[0] - half, "y": middle[1] - half, "width": DISC_PX, "height": DISC_PX}
    return np.asarray(Image.open(io.BytesIO(tab.screenshot(clip=clip))).convert("RGB"), dtype=np.int16)


def _middle(tab: Any, selector: str) -> tuple[float, float]:
    tab.locator(selector).first.wait_for()
    box = tab.locator(selector).first.bounding_box()
    assert box["width"] == pytest.approx(DISC_PX, abs=1)
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_the_held_disc_of_a_phone_matches_the_drawing(chromium: Any, shared: Path, url: str, theme: str) -> None:
    drawn_tab = chromium.new_page(viewport=PHONE)
    drawn_tab.goto((shared / "page/mock.html").as_uri() + f"#theme={theme}")
    drawn = _around(drawn_tab, _middle(drawn_tab, ".disc"))
    drawn_tab.close()
    context = chromium.new_context(viewport=PHONE, has_touch=True, is_mobile=True, color_scheme=theme)
    tab = context.new_page()
    tab.set_default_timeout(PATIENCE_MS)
    tab.goto(url)
    x, y = _middle(tab, ".disc")
    touch = context.new_cdp_session(tab)
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
    moved = {"type": "touchMove", "touchPoints": [{"x": x + KNOB[0], "y": y + KNOB[1]}]}
    touch.send("Input.dispatchTouchEvent", moved)
    tab.locator(".disc .ring:not(.rest)").wait_for()
    tab.wait_for_timeout(500)  # its colors fade in
    actual = _around(tab, (x, y))
    context.close()

    OUT.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.hstack([drawn, actual]).astype(np.uint8)).save(OUT / f"disc {theme}.png")
    mask = np.hypot(*np.mgrid[-74:74, -74:74]) < FACE_PX
    alike = (np.abs(drawn - actual).max(axis=-1) < _LIKE)[mask]
    assert alike.mean() > 0.97, f"see {OUT}/disc {theme}.png"
