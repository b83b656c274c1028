"""A narrow window that is not a phone's: the bar and the dock's bar are fully visible."""

from typing import Any

import pytest
from tests.page.built_client import needs_client

from trundle.page import ClockState, PageServer

pytestmark = [pytest.mark.slow, needs_client]
_ENDS = "[...document.querySelector('header').children].map((child) => child.getBoundingClientRect().right)"


@pytest.mark.parametrize("width", [680, 720, 1024])
def test_the_whole_bar_of_a_simulation_is_visible(chromium: Any, page: PageServer, width: int) -> None:
    tab = chromium.new_page(viewport={"width": width, "height": 900})
    tab.goto(page.url)
    tab.get_by_label("Connected").first.wait_for()
    page.put_state(ClockState(time_ns=61_500_000_000, paused=False, real_time_factor=0.48, recording=None))
    tab.get_by_role("banner").get_by_role("button", name="Record").wait_for()

    assert max(tab.evaluate(_ENDS)) <= width
    tab.close()


def test_a_narrow_dock_shows_its_tabs_and_the_collapse_button(chromium: Any, page: PageServer) -> None:
    tab = chromium.new_page(viewport={"width": 720, "height": 900})
    tab.goto(page.url)
    tab.get_by_label("Connected").first.wait_for()
    dock = tab.locator(".dock")
    dock.get_by_role("tab", name="Plots").click()  # nothing is driven here: the dock begins closed
    dock.get_by_role("button", name="Add curve").first.wait_for()

    fold = dock.get_by_role("button", name="Collapse the dock").bounding_box()
    edge = dock.bounding_box()
    assert fold["x"] + fold["width"] <= edge["x"] + edge["width"]
    plots = dock.get_by_role("tab", name="Plots").bounding_box()
    assert plots["width"] > 40
    tab.close()
