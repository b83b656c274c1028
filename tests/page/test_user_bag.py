"""A user plays a bag and scrubs its timeline."""

import os
from pathlib import Path
from typing import Any

import pytest
from tests.page.bag.test_source import MAP, START, TEXT, S, text
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser

from trundle.base.http.page_address import PageAddress
from trundle.page import BagFile, PageServer, Session
from trundle.ros import BagMessage, create_bag

pytestmark = [pytest.mark.slow, needs_client]


def test_a_bag_is_scrubbed_and_played(chromium: Any, tmp_path: Path) -> None:
    """The bag has a text each second; the current one is echoed."""
    path = tmp_path / "words.bag"
    with create_bag(path) as writer:
        for second in range(11):
            writer.write(BagMessage(TEXT, START + second * S, text(f"word {second}")))
    playing = BagFile(path=os.fsencode(path), speed=1.0, paused=True)
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


def test_every_topic_has_a_lane_from_the_index(chromium: Any, tmp_path: Path) -> None:
    """The bag lasts ten seconds and is not played; a click in the ruler seeks to a band's time."""
    path = tmp_path / "lanes.bag"
    with create_bag(path) as writer:
        writer.write(BagMessage(MAP, START, text("map")))
        for tick in (*range(41), *range(80, 101)):
            writer.write(BagMessage(TEXT, START + tick * S // 10, text(str(tick))))
    playing = BagFile(path=os.fsencode(path), speed=1.0, paused=True)
    with PageServer.start(Session(title="lanes", kind="bag"), at=PageAddress(port=0), bag=playing) as server:
        user = PanelUser(chromium, server.url)
        user.open("Timeline")
        lane = user.page.get_by_role("group", name="/text", exact=True)
        lane.locator(".band").first.wait_for()
        left, width = lane.evaluate("e => [e.getBoundingClientRect().left, e.clientWidth]")
        spans = lane.locator(".band").evaluate_all("all => all.map(e => e.getBoundingClientRect().toJSON())")
        covered = [
            any(band["left"] <= left + width * share <= band["right"] + 3 for band in spans)
            for share in (0.101, 0.301, 0.5, 0.7, 0.901)
        ]
        assert covered == [True, True, False, False, True]
        rare = user.page.get_by_role("group", name="/map", exact=True)
        assert rare.locator(".band").count() == 1
        assert rare.locator(".band").bounding_box()["width"] < 0.01 * width
        user.page.get_by_title("/text: 62 messages").wait_for()
        user.close()
