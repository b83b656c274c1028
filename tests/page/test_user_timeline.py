"""A user scrubs and folds the timeline, whose dock is as high as its lanes."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import running_graph
from tests.page.bag.test_source import START, S, connection, text
from tests.page.built_client import needs_client
from tests.page.driving.test_driving import Robot
from tests.page.panel_user import PanelUser

from trundle.base.http.page_address import PageAddress
from trundle.page import BagFile, ClockState, GraphAddress, PageServer, Session, TimelineSpan
from trundle.ros import BagMessage, create_bag

pytestmark = [pytest.mark.slow, needs_client]

TOPICS = ("/scan", "/odom", "/battery")


def _dock(user: PanelUser) -> dict[str, float]:
    user.until_still(lambda: user.page.locator(".dock").bounding_box())
    return user.page.locator(".dock").bounding_box()


def test_the_dock_opens_once_there_is_a_robot_to_drive(chromium: Any) -> None:
    with running_graph() as graph:
        owner = graph.node("owner")
        address = GraphAddress(master_uri=graph.core.uri)
        session = Session(title="t", kind="graph", drive_topic="/cmd_vel")
        with PageServer.start(session, at=PageAddress(port=0), graph=address, node=owner) as server:
            user = PanelUser(chromium, server.url)
            user.page.locator(".dock.shut").wait_for()
            assert _dock(user)["height"] < 40
            user.button("Open the dock").wait_for()
            Robot(graph.node("robot"), "/cmd_vel")
            user.page.locator(".dock:not(.shut)").wait_for()
            user.button("Collapse the dock").wait_for()
            user.close()


@pytest.fixture
def bag_user(chromium: Any, tmp_path: Path) -> Iterator[PanelUser]:
    path = tmp_path / "lanes.bag"
    with create_bag(path) as writer:
        for second in range(11):
            for topic in TOPICS:
                writer.write(BagMessage(connection(topic, "std_msgs/String"), START + second * S, text(topic)))
    playing = BagFile(path=os.fsencode(path), speed=1.0, paused=True)
    with PageServer.start(Session(title="lanes", kind="bag"), at=PageAddress(port=0), bag=playing) as server:
        user = PanelUser(chromium, server.url)
        user.page.get_by_role("group", name="/scan", exact=True).wait_for()
        yield user
        user.close()


def test_lanes_of_a_kind_fold_and_the_dock_follows_their_height(bag_user: PanelUser) -> None:
    open_px = _dock(bag_user)
    upper, lower = (
        bag_user.page.get_by_role("group", name=one, exact=True).bounding_box() for one in ("/odom", "/scan")
    )
    lane_px = lower["y"] - upper["y"]
    last = bag_user.page.locator(".timeline > :last-child").bounding_box()
    assert last["y"] + last["height"] == pytest.approx(open_px["y"] + open_px["height"], abs=3)

    fold = bag_user.page.get_by_role("button", name=f"Topics {len(TOPICS)}", exact=True)
    fold.click()
    bag_user.page.get_by_role("group", name="/scan", exact=True).wait_for(state="detached")
    assert fold.get_attribute("aria-expanded") == "false"
    together = bag_user.page.get_by_role("group", name="Topics", exact=True)
    assert together.locator(".band").count() >= 1
    assert open_px["height"] - _dock(bag_user)["height"] == pytest.approx(len(TOPICS) * lane_px, abs=2)

    fold.click()
    bag_user.page.get_by_role("group", name="/battery", exact=True).wait_for()
    assert _dock(bag_user)["height"] == pytest.approx(open_px["height"], abs=1)


def test_a_press_on_a_lane_scrubs_and_the_pointer_shows_its_time(bag_user: PanelUser) -> None:
    mouse, head = bag_user.page.mouse, bag_user.page.get_by_role("slider", name="Time")
    lane = bag_user.page.get_by_role("group", name="/odom", exact=True).bounding_box()

    def at(share: float) -> tuple[float, float]:
        return lane["x"] + share * lane["width"], lane["y"] + lane["height"] / 2

    def time() -> float:
        return float(head.get_attribute("aria-valuenow")) - START / S

    mouse.move(*at(0.3))
    pointed = bag_user.page.locator(".pointed")
    assert pointed.inner_text().startswith(("1:42.9", "1:43.0"))
    mouse.down()
    bag_user.until(lambda: time() == pytest.approx(3.0, abs=0.1), what="for the press")
    mouse.move(*at(0.8), steps=5)
    bag_user.until(lambda: time() == pytest.approx(8.0, abs=0.1), what="for the drag")
    pointed.wait_for(state="detached")
    mouse.up()
    mouse.move(*at(0.5))
    bag_user.until(lambda: pointed.inner_text().startswith(("1:44.9", "1:45.0")), what="for the pointer's time")
    assert time() == pytest.approx(8.0, abs=0.1)


def test_the_bar_tells_how_far_in_the_past_it_is(chromium: Any, page: PageServer) -> None:
    user = PanelUser(chromium, page.url)
    page.put_state(ClockState(time_ns=S, paused=True, speed=1.0, timeline=TimelineSpan(0, 80 * S)))
    user.button("Open the dock").click()
    user.open("Timeline")
    actions = user.page.locator(".dock .acts")
    actions.get_by_text("past, 1:19 ago", exact=True).wait_for()
    actions.get_by_role("button", name="Resume here", exact=True).wait_for()
    actions.get_by_role("button", name="Back to now", exact=True).wait_for()
    page.put_state(ClockState(time_ns=80 * S, paused=True, speed=1.0, timeline=TimelineSpan(0, 80 * S)))
    actions.get_by_text("past, ").wait_for(state="detached")
    user.close()
