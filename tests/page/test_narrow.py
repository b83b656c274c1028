"""A window that is narrow, and no phone's: the whole bar is seen."""

from typing import Any

import pytest
from tests.page.built_client import needs_client

from trundle.page import ClockState, PageServer

pytestmark = [pytest.mark.slow, needs_client]
_ENDS = "[...document.querySelector('header').children].map((child) => child.getBoundingClientRect().right)"


@pytest.mark.parametrize("width", [680, 720, 1024])
def test_the_whole_bar_of_a_simulation_is_seen(chromium: Any, page: PageServer, width: int) -> None:
    tab = chromium.new_page(viewport={"width": width, "height": 900})
    tab.goto(page.url)
    tab.get_by_label("Connected").first.wait_for()
    page.put_state(ClockState(time_ns=61_500_000_000, paused=False, real_time_factor=0.48, recording=None))
    tab.get_by_role("banner").get_by_role("button", name="Record").wait_for()

    assert max(tab.evaluate(_ENDS)) <= width
    tab.close()
