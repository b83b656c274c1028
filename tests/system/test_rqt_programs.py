"""Panels of rqt's programs on the launch's page."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.system.browser import running_page

pytestmark = [pytest.mark.browser, pytest.mark.slow, needs_client]

ARM = """<robot name="r"><link name="base"/><link name="arm"/><joint name="shoulder" type="revolute">
<parent link="base"/><child link="arm"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="20" velocity="1"/>
</joint></robot>"""
LAUNCH = """<launch>
<param name="robot_description" textfile="$(dirname)/arm.urdf"/>
<node pkg="rviz" type="rviz" name="rviz"/>
<node pkg="robot_state_publisher" type="robot_state_publisher" name="frames"/>
<node pkg="joint_state_publisher_gui" type="joint_state_publisher_gui" name="sliders"/>
<node pkg="joy" type="joy_node" name="stick"/>
<node pkg="rqt_plot" type="rqt_plot" name="plot" args="/joint_states/position[0]"/>
<node pkg="rqt_topic" type="rqt_topic" name="topic"/>
<node pkg="rqt_console" type="rqt_console" name="console"/>
<node pkg="rqt_graph" type="rqt_graph" name="graph"/>
<node pkg="rqt_bag" type="rqt_bag" name="bag"/>
<node pkg="rqt_image_view" type="rqt_image_view" name="image" args="/eye/image_raw"/>
<node pkg="rqt_tf_tree" type="rqt_tf_tree" name="tree"/>
<node pkg="rqt_reconfigure" type="rqt_reconfigure" name="options"/>
<node pkg="rqt_robot_steering" type="rqt_robot_steering" name="steering">
<param name="default_topic" value="/base/cmd_vel"/></node>
<node pkg="topic_tools" type="relay" name="base" args="/base/cmd_vel /wheels"/>
</launch>"""
SHOWN = {
    "Plots": ("rqt_plot", "position[0]"),
    "Topics": ("rqt_topic", "sensor_msgs/JointState"),
    "Log": ("rqt_console", "Message"),
    "Graph": ("rqt_graph", "/frames"),
    "Timeline": ("rqt_bag", "There is no timeline"),
    "Images": ("rqt_image_view", "/eye/image_raw"),
    "TF tree": ("rqt_tf_tree", "arm"),
    "Reconfigure": ("rqt_reconfigure", "No node has options"),
    "Steering": ("rqt_robot_steering", "Hold a slider to drive"),
    "Joints": ("joint_state_publisher_gui", "shoulder"),
    "Joystick": ("joy", "Left stick"),
}
"""Panel → the replaced program, and a text in the panel."""


@pytest.fixture(scope="module")
def user(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[PanelUser]:
    folder: Path = tmp_path_factory.mktemp("programs")
    (folder / "arm.urdf").write_text(ARM)
    (folder / "all.launch").write_text(LAUNCH)
    words = ("launch", "all.launch", "--port", "0", "--view-port", "0")
    with running_page(*words, environment={"HOME": str(folder)}, folder=folder) as url:
        user = PanelUser(chromium, url)
        yield user
        user.close()


def test_the_page_has_a_panel_for_each_program(user: PanelUser) -> None:
    def panels() -> set[str]:
        answer = user.page.request.get(f"{user.page.url}session.json")
        return set(answer.json()["panels"])

    user.until(lambda: panels() == {program for program, _ in SHOWN.values()}, what=f"for all programs: {panels()}")
    for panel in SHOWN:  # wait for all, as a later panel would be in front
        user.page.locator(".dv-tab", has_text=panel).wait_for()
    for panel, (_, text) in SHOWN.items():
        user.open(panel)
        shown = user.page.locator(".dv-content-container").get_by_text(text).locator("visible=true")
        user.until(lambda shown=shown: shown.count() > 0, what=f"for {text} in {panel}")
    user.open("Steering")
    assert user.page.get_by_role("combobox", name="Topic of the velocity").input_value() == "/base/cmd_vel"


def test_a_slider_of_the_page_moves_a_joint(user: PanelUser) -> None:
    user.open("Joints")
    user.type("shoulder [rad]", "0.25")
    user.open("Plots")
    value = user.page.locator(".legend b", has_text="0.250")
    user.until(value.is_visible, what="for 0.250")
