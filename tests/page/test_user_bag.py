"""A person plays a bag: the timeline is scrubbed, and what is shown follows."""

from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.page.test_bag import START, TEXT, S, text

from trundle.page import BagFile, PageServer, Session
from trundle.page_address import PageAddress
from trundle.ros import BagMessage, create_bag

pytestmark = [pytest.mark.slow, needs_client]


def test_a_bag_is_scrubbed_and_played(chromium: Any, tmp_path: Path) -> None:
    """A text a second: the one of the time is echoed."""
    path = tmp_path / "words.bag"
    with create_bag(path) as writer:
        for second in range(11):
            writer.write(BagMessage(TEXT, START + second * S, text(f"word {second}")))
    playing = BagFile(path=str(path), speed=1.0, paused=True)
    with PageServer.start(Session(title="words", kind="bag"), at=PageAddress(port=0), bag=playing) as server:
        user = PanelUser(chromium, server.url)
        user.open("Timeline")
        head = user.page.get_by_role("slider", name="Time")
        head.wait_for()
        user.open("Topics")
        user.button("/text").click()
        user.page.get_by_role("treeitem", name="data word 0").wait_for()
        user.open("Timeline")
        head.press("End")
        user.page.locator('[role=slider][aria-valuetext="1:50.00"]').wait_for()
        user.open("Topics")
        user.page.get_by_role("treeitem", name="data word 10").wait_for()
        user.open("Timeline")
        ruler = user.page.locator(".headarea").bounding_box()
        user.page.mouse.click(ruler["x"] + 0.45 * ruler["width"], ruler["y"] + 10)
        user.open("Topics")
        user.page.get_by_role("treeitem", name="data word 4").wait_for()
        user.page.get_by_role("banner").get_by_role("button", name="Play", exact=True).click()
        user.page.get_by_role("treeitem", name="data word 6").wait_for()
        user.close()
