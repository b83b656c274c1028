"""A user of the panel Navigation sends a robot around two rooms, and takes its map home."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.navigation.move_base.two_rooms_package import make_two_rooms
from tests.page.built_client import needs_client
from tests.page.scene_user import PX_PER_M, Point, SceneUser, rviz_text
from tests.system.browser import running_page

pytestmark = [needs_client, pytest.mark.slow]

LAUNCH = """<launch>
<include file="$(find two_rooms)/two_rooms.launch"/>
<param name="/move_base/recovery_behavior_enabled" value="false"/>
<node pkg="rviz" type="rviz" name="rviz" args="-d $(dirname)/top.rviz"/>
</launch>"""
DISPLAYS = (
    {"Class": "rviz/Map", "Name": "Map", "Topic": "/map", "Enabled": True},
    {"Class": "rviz/Path", "Name": "Path", "Topic": "/move_base/NavfnROS/plan", "Enabled": True},
)


class Navigator(SceneUser):
    """Reads the panel Navigation."""

    @property
    def states(self) -> list[str]:
        """Return the states of the goals, in their order."""
        return self.page.locator(".dockhost table.data tbody tr td:nth-child(2)").all_inner_texts()

    @property
    def state(self) -> str:
        return self.page.locator(".navigation").get_by_role("status").inner_text()

    def find_origin(self) -> None:
        """Find the origin's position in the page by a goal, which is removed again."""
        self.button("Add goals").click()
        width, height = self.page.viewport_size["width"], self.page.viewport_size["height"]
        start = (width / 2, height / 3)
        self.page.mouse.move(*start)
        self.page.mouse.down()
        self.page.mouse.move(start[0] + 30, start[1])
        self.page.mouse.up()
        x, y = (float(self.cell(column).replace("−", "-")) for column in (3, 4))
        self.origin = (start[0] - PX_PER_M * x, start[1] + PX_PER_M * y)
        self.button("Remove goal 1").click()
        self.button("Add goals").click()

    def at(self, point: Point) -> Point:
        """Return the position of a point of the ground in the page [px]."""
        return (self.origin[0] + PX_PER_M * point[0], self.origin[1] - PX_PER_M * point[1])

    def cell(self, column: int) -> str:
        """Return the text of a column of the first goal."""
        return str(self.page.locator(f".dockhost table.data tbody tr td:nth-child({column})").first.inner_text())

    @property
    def arrows(self) -> float:
        """Return the area of the ground under magenta arrows [m²]."""
        red, green, blue = self.picture().astype(int).transpose(2, 0, 1)
        return float(((red > 100) & (blue > 100) & (green < 80)).sum() / PX_PER_M**2)

    def number(self, label: str) -> float:
        """Return the first number of a row of the panel; NaN: it has none."""
        name = self.page.locator(".navigation .label").get_by_text(label, exact=True)
        text = name.locator("xpath=../*[2]").inner_text().split()[0].rstrip("°").replace("−", "-")
        return math.nan if text == "—" else float(text)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("navigates")
    make_two_rooms(folder)
    (folder / "top.rviz").write_text(rviz_text(*DISPLAYS))
    (folder / "tour.launch").write_text(LAUNCH)
    return folder


@pytest.fixture(scope="module")
def user(chromium: Any, folder: Path) -> Iterator[Navigator]:
    environment = {"ROS_MASTER_URI": "", "HOME": str(folder), "ROS_PACKAGE_PATH": str(folder)}
    words = ("launch", "tour.launch", "--view-port", "0", "--port", "0")
    with running_page(*words, environment=environment, folder=folder) as url:
        user = Navigator(chromium, url)
        user.open("Navigation")
        user.sees("Add goals")
        yield user
        assert user.faults == []
        user.close()


def test_stop_cancels_a_goal_that_did_not_come_from_the_panel(user: Navigator) -> None:
    user.until(lambda: user.state in ("Driving", "Reached"), what="for the goal that the world's plugin sends")
    user.find_origin()
    user.tool("2D Nav Goal")
    user.drag((-2.5, -1.0), (-2.5, -0.8))
    user.until(lambda: user.state == "Driving", what="for the far goal")
    user.button("Stop").click()
    user.until(lambda: user.state == "Canceled", what="for the robot to stop")


def test_goals_are_added_in_the_scene_and_driven_to_in_their_order(user: Navigator) -> None:
    user.button("Add goals").click()
    user.drag((-2.0, 0.6), (-1.6, 0.6))
    user.drag((-1.0, -0.8), (-1.0, -0.4))
    user.button("Add goals").click()
    assert user.states == ["waiting", "waiting"]
    user.until(lambda: 0.02 < user.arrows < 0.1, what="for two arrows of 0.45 m")
    user.button("Start").click()
    user.until(lambda: user.states == ["driving", "waiting"], what="for the first goal")
    user.until(lambda: user.states == ["reached", "driving"], what="for the second goal")
    user.until(lambda: user.states == ["reached", "reached"], what="for the end of the tour")
    assert user.state == "Reached"
    user.until(lambda: abs(user.number("x") + 1.0) < 0.3, what="for the pose at the last goal")
    assert abs(user.number("y") + 0.8) < 0.3
    assert abs(user.number("Yaw") - 90.0) < 30.0
    user.button("Clear goals").click()
    user.sees("then press at each place")


def test_a_goal_in_a_wall_fails_with_the_nodes_reason(user: Navigator) -> None:
    user.button("Add goals").click()
    user.drag((0.0, -0.6), (0.4, -0.6))
    user.button("Start").click()
    user.until(lambda: user.states and user.states[0].startswith("failed: "), what="for the failure")
    user.button("Start").wait_for(state="detached")
    user.button("Remove goal 1").click()
    user.button("Clear costmaps").click()
    user.page.locator(".navigation .fault").wait_for(state="detached")


def test_the_map_is_saved_as_map_saver_does(user: Navigator, folder: Path) -> None:
    saved: dict[str, Path] = {}

    def keep(download: Any) -> None:
        download.save_as(folder / download.suggested_filename)
        saved[download.suggested_filename] = folder / download.suggested_filename

    user.page.on("download", keep)
    user.button("Save map").click()
    user.until(lambda: len(saved) == 2, what="for two files")
    original = folder / "two_rooms"
    of_map = (original / "map.pgm").read_bytes()
    assert saved["map.pgm"].read_bytes()[-140 * 80 :] == of_map[-140 * 80 :]
    assert (
        saved["map.yaml"]
        .read_text()
        .startswith("image: map.pgm\nresolution: 0.050000\norigin: [-3.500000, -2.000000, 0.000000]\n")
    )
