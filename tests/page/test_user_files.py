"""A user opens an .rviz file in the page, edits and downloads it."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import SceneUser, rviz_text

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session
from trundle.ros import Node

pytestmark = [pytest.mark.slow, needs_client]

ROS_2 = """Panels:
  - Class: rviz_common/Displays
    Name: Displays
Visualization Manager:
  Displays:
    - Class: rviz_default_plugins/Marker
      Name: Cube
      Enabled: true
      Topic: {Value: /cube, Depth: 5, Durability Policy: Volatile}
      Strange: 42
    - Class: nav2_rviz_plugins/ParticleCloud
      Name: Particles
      Enabled: true
  Global Options:
    Background Color: 0; 0; 0
    Fixed Frame: map
  Views:
    Current: {Class: rviz_default_plugins/TopDownOrtho, Name: Current View, Scale: 100, X: 0, Y: 0, Angle: 0}
    Saved: ~
Window Geometry:
  Height: 800
"""
"""File as RViz 2 writes it."""


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def node(graph: Graph) -> Node:
    node = graph.node("tester")
    cube = {"type": 1, "scale": {"x": 1.0, "y": 1.0, "z": 1.0}, "color": {"r": 1.0, "a": 1.0}}
    cube |= {"header": {"frame_id": "map"}, "pose": {"orientation": {"w": 1.0}}}
    node.advertise("/cube", "visualization_msgs/Marker", latch=True).publish(cube)
    return node


@pytest.fixture(scope="module")
def user(chromium: Any, graph: Graph, node: Node) -> Iterator[SceneUser]:
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0), graph=address) as server:
        user = SceneUser(chromium, server.url)
        yield user
        user.close()


def _choose(user: SceneUser, command: str) -> None:
    user.page.keyboard.press("Control+k")
    user.page.get_by_role("combobox", name="Search commands").fill(command)
    user.page.get_by_role("option", name=command).click()


def test_a_file_of_ros_2_is_opened_and_its_unknown_parts_are_kept(user: SceneUser, tmp_path: Path) -> None:
    import yaml

    file = tmp_path / "two.rviz"
    file.write_text(ROS_2)
    with user.page.expect_file_chooser() as chooser:
        _choose(user, "Open an .rviz file")
    chooser.value.set_files(file)
    user.page.get_by_role("treeitem").filter(has_text="Particles").first.wait_for()
    user.page.get_by_text("not supported").first.wait_for()
    user.until(lambda: user.sees_at((0.0, 0.0)), what="for the cube")
    assert user.area((0, 0, 0)) > 1.0
    user.page.get_by_role("treeitem").filter(has_text="Cube").first.focus()
    user.page.keyboard.press(" ")
    user.until(lambda: not user.sees_at((0.0, 0.0)), what="for the end of the cube")
    with user.page.expect_download() as download:
        user.button("Download").click()

    assert download.value.suggested_filename == "two.rviz"
    saved, expected = yaml.safe_load(download.value.path().read_text()), yaml.safe_load(ROS_2)
    cube, particles = saved["Visualization Manager"]["Displays"]
    assert particles == expected["Visualization Manager"]["Displays"][1]
    assert (cube["Class"], cube["Enabled"], cube["Strange"]) == ("rviz_default_plugins/Marker", False, 42)
    assert cube["Topic"]["Value"] == "/cube"
    assert (saved["Panels"], saved["Window Geometry"]) == (expected["Panels"], expected["Window Geometry"])


def test_the_details_of_the_notice_name_every_display_without_data(user: SceneUser) -> None:
    """One display of the notice is selected in the list, with its reason."""
    silent = [
        {"Class": "rviz/LaserScan", "Name": "Front laser", "Enabled": True, "Topic": "/front"},
        {"Class": "rviz/LaserScan", "Name": "Rear laser", "Enabled": True, "Topic": "/rear"},
        {"Class": "rviz/PointCloud2", "Name": "Depth cloud", "Enabled": True, "Topic": "/depth"},
    ]
    user.drop_file("silent.rviz", rviz_text(*silent))
    line = user.page.get_by_role("status").filter(has_text="3 displays have no data")
    line.get_by_role("button", name="Details").click()
    dialog = user.page.get_by_role("dialog", name="Problems")
    rows = dialog.locator(".fault-row")
    user.until(lambda: rows.count() == 3)
    assert [rows.nth(i).locator("b").inner_text() for i in range(3)] == [display["Name"] for display in silent]
    rows.filter(has_text="Rear laser").get_by_role("button", name="Show").click()
    dialog.wait_for(state="detached")
    user.page.get_by_role("treeitem").filter(has_text="Rear laser").first.wait_for()
    user.page.get_by_text("No messages received").first.wait_for()


IN_GROUP = {
    "Class": "rviz/Group",
    "Name": "Things",
    "Enabled": True,
    "Displays": [{"Class": "rviz/Marker", "Name": "Cube", "Enabled": True, "Marker Topic": "/cube", "Queue Size": 7}],
}


def test_a_dropped_file_is_shown_and_its_group_is_toggled(user: SceneUser) -> None:
    """Displays in the group keep their own checkboxes."""
    import yaml

    user.drop_file("dropped.rviz", rviz_text(IN_GROUP))
    group = user.page.get_by_role("treeitem").filter(has_text="Things").first
    group.wait_for()
    user.until(lambda: user.sees_at((0.0, 0.0)), what="for the cube")
    group.focus()
    user.page.keyboard.press(" ")
    user.until(lambda: not user.sees_at((0.0, 0.0)), what="for the end of the cube")
    with user.page.expect_download() as download:
        user.button("Download").click()
    user.page.keyboard.press("Control+z")
    user.until(lambda: user.sees_at((0.0, 0.0)), what="for the cube, once more")

    assert download.value.suggested_filename == "dropped.rviz"
    (saved,) = yaml.safe_load(download.value.path().read_text())["Visualization Manager"]["Displays"]
    (cube,) = saved["Displays"]
    assert (saved["Class"], saved["Name"], saved["Enabled"]) == ("rviz/Group", "Things", False)
    assert (cube["Enabled"], cube["Marker Topic"], cube["Queue Size"]) == (True, "/cube", 7)
