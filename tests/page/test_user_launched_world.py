"""A user of a launch with gzserver goes back in time, builds a model, saves and reloads the world."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.cart_builder import CartBuilder
from tests.system.browser import running_page

import trundle

pytestmark = [needs_client, pytest.mark.slow]

WORLD = """<sdf version="1.6"><world name="{}"><include><uri>model://ground_plane</uri></include>
<model name="{}"><pose>2 0 0.5 0 0 0</pose><link name="body"/></model></world></sdf>"""
ROBOT = """<robot name="robot"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size="1 1 0.2"/></geometry></collision></link></robot>"""
LAUNCH = """<launch>
<param name="robot_description" textfile="$(dirname)/robot.urdf"/>
<node pkg="gazebo_ros" type="gzserver" name="gazebo" args="$(dirname)/yard.world"/>
<node pkg="gazebo_ros" type="gzclient" name="gzclient"/>
<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model robot -z 4"/>
<node pkg="robot_state_publisher" type="robot_state_publisher" name="states"/>
</launch>"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("launched")
    (folder / "yard.world").write_text(WORLD.format("yard", "post"))
    (folder / "robot.urdf").write_text(ROBOT)
    (folder / "robot.launch").write_text(LAUNCH)
    return folder


@pytest.fixture(scope="module")
def user(chromium: Any, folder: Path) -> Iterator[CartBuilder]:
    environment = {"ROS_MASTER_URI": "", "HOME": str(folder)}
    words = ("launch", "robot.launch", "--view-port", "0", "--port", "0")
    with running_page(*words, environment=environment, folder=folder) as url:
        user = CartBuilder(chromium, url)
        user.until(lambda: user.model("robot") is not None, what="for the robot")
        yield user
        user.close()


def test_the_timeline_seeks_to_before_the_robots_fall_and_runs_on(user: CartBuilder) -> None:
    user.until(lambda: user.position("robot")[2] < 0.2, what="for the robot on the ground")
    user.page.get_by_role("banner").get_by_role("button", name="Pause").click()
    user.until(lambda: user.is_paused, what="for the pause")
    user.open("Timeline")
    head = user.page.get_by_role("slider", name="Time")
    user.until(lambda: float(head.get_attribute("aria-valuemin")) < float(head.get_attribute("aria-valuenow")))
    head.press("Home")
    user.until(lambda: not user.model("robot") or user.position("robot")[2] > 0.5, what="for the time before its fall")
    head.press("End")
    user.until(
        lambda: user.model("robot") and user.position("robot")[2] < 0.2, what="for the robot on the ground again"
    )


def test_a_model_is_built_and_the_world_saved_with_it(user: CartBuilder, folder: Path) -> None:
    user.begin()
    user.rename("crate")
    user.add("Link", "box", "box")
    user.button("Finish").click()
    user.until(lambda: user.model("crate") and user.draft() is None, what="for the crate in the world")
    user.page.locator("canvas").first.focus()
    user.page.keyboard.press("Control+s")
    dialog = user.page.get_by_role("dialog", name="Save the world as SDF")
    dialog.get_by_label("File").fill("saved.world")
    dialog.get_by_role("button", name="Save", exact=True).click()
    user.page.get_by_role("status").get_by_text("saved as saved.world").wait_for()
    saved = trundle.load(str(folder / "saved.world"))
    assert [model.name for model in saved.models] == ["ground_plane", "post", "robot", "crate"]


def test_the_launch_is_reloaded_with_its_changed_files(user: CartBuilder, folder: Path) -> None:
    (folder / "yard.world").write_text(WORLD.format("garden", "tree"))
    user.button("World's menu").click()
    user.page.get_by_role("menuitem", name="Load the world again").click()
    names = ["ground_plane", "tree", "robot"]
    user.until(lambda: [model["name"] for model in user.manifest()["models"]] == names, what="for the new world")
    user.page.get_by_role("tree", name="World").get_by_role("treeitem").filter(has_text="garden").wait_for()
    user.until(lambda: user.position("robot")[2] < 0.2, what="for the robot on the ground")
