"""A user controls a simulation; its clock, its topics and its recording are checked."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import VIEW_CANVAS, SceneUser
from tests.system.browser import running_page

from trundle.ros import Node
from trundle.sim.simulation import read_state_log

pytestmark = needs_client

STEP_NS = 10_000_000
HEIGHT = 2.0
"""Initial height of the balloon [m]."""
ARM = """<link name="arm"><pose>0.5 0 0 0 0 0</pose></link>
<joint name="hinge" type="revolute"><parent>base</parent><child>arm</child>
<axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper><effort>9</effort></limit></axis></joint>"""
PLUGINS = """<plugin name="truth" filename="libgazebo_ros_p3d.so"><bodyName>base</bodyName><topicName>/truth</topicName>
</plugin><plugin name="states" filename="libgazebo_ros_joint_state_publisher.so"><jointName>hinge</jointName>
<updateRate>50</updateRate></plugin>"""


def _world(more: str = "") -> str:
    """Return a world with a rising balloon with an arm, and further models."""
    box = "<geometry><box><size>0.4 0.4 0.4</size></box></geometry>"
    link = f'<link name="base"><visual name="body">{box}</visual></link>'
    balloon = f'<model name="balloon"><pose>0 0 {HEIGHT} 0 0 0</pose>{link}{ARM}{PLUGINS}</model>'
    step = "<physics type='ode'><max_step_size>0.01</max_step_size></physics>"
    return f'<sdf version="1.6"><world name="sky"><gravity>0 0 0.1</gravity>{step}{balloon}{more}</world></sdf>'


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def node(graph: Graph) -> Node:
    return graph.node("tester")


Heights = list[tuple[int, float]]
"""Simulation time [ns] and height of the balloon [m] at each step."""


@pytest.fixture(scope="module")
def heights(node: Node) -> Heights:
    heights: Heights = []

    def receive(message: Any) -> None:
        stamp = message.header.stamp
        heights.append((stamp.sec * 10**9 + stamp.nanosec, message.pose.pose.position.z))

    node.subscribe("/truth", "nav_msgs/Odometry", receive, queue_size=None)
    return heights


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sky")
    (folder / "sky.sdf").write_text(_world())
    return folder


@pytest.fixture(scope="module")
def user(chromium: Any, graph: Graph, heights: Heights, folder: Path) -> Iterator[SceneUser]:
    words = ("run", "sky.sdf", "--pause", "--port", "0")
    with running_page(*words, environment={"ROS_MASTER_URI": graph.core.uri}, folder=folder) as url:
        user = SceneUser(chromium, url)
        yield user
        user.close()


def _bar(user: SceneUser, name: str) -> Any:
    return user.page.get_by_role("banner").get_by_role("button", name=name, exact=True)


def _choose(user: SceneUser, menu: str, entry: str) -> None:
    _bar(user, menu).click()
    user.page.get_by_role("menu").get_by_text(entry, exact=True).click()


def _at_rest(user: SceneUser, heights: Heights) -> int:
    """Wait until the world is paused after at least one step; return its time [ns]."""
    _bar(user, "Play").wait_for()
    if not heights:
        _bar(user, "Step 1").click()
        user.until(lambda: heights)
    user.until_still(lambda: len(heights))
    return heights[-1][0]


def _run_on(user: SceneUser, heights: Heights) -> int:
    """Run the world for at least 1.5 s, in which the balloon rises; return the time at the pause [ns]."""
    before = _at_rest(user, heights)
    _bar(user, "Play").click()
    user.until(lambda: heights[-1][0] > before + 1.5e9)
    _bar(user, "Pause").click()
    return _at_rest(user, heights)


def test_play_and_pause_are_one_toggle(graph: Graph, user: SceneUser, heights: Heights) -> None:
    """The bar's clock shows the time of the pause."""
    _bar(user, "Play").click()
    graph.until(lambda: heights)
    _bar(user, "Pause").click()
    time_s = _at_rest(user, heights) / 1e9
    user.page.get_by_role("banner").get_by_text(f"0:{time_s:05.2f}", exact=True).wait_for()


@pytest.mark.slow
def test_step_does_one_physics_step(user: SceneUser, heights: Heights) -> None:
    """Both the button and the key do so."""
    before = _at_rest(user, heights)
    _bar(user, "Step 1").click()
    user.until(lambda: heights[-1][0] > before)
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press(".")
    user.until(lambda: heights[-1][0] > before + STEP_NS)

    assert _at_rest(user, heights) == before + 2 * STEP_NS
    assert [time_ns for time_ns, _ in heights[-3:]] == [before, before + STEP_NS, before + 2 * STEP_NS]


@pytest.mark.slow
def test_the_speed_is_set_and_shown(user: SceneUser, heights: Heights) -> None:
    """The bar shows the simulation's speed; Space plays although the menu had the focus."""
    before = _at_rest(user, heights)
    _choose(user, "Speed 1×", "As fast as possible")
    _bar(user, "As fast as possible").wait_for()
    user.page.keyboard.press("Space")
    user.until(lambda: heights[-1][0] > before + 2 * 10**9)
    _bar(user, "Pause").click()
    _choose(user, "As fast as possible", "1×")
    _bar(user, "Speed 1×").wait_for()


@pytest.mark.slow
def test_time_and_poses_are_reset_together_or_separately(user: SceneUser, heights: Heights) -> None:
    """A step shows the state after the reset."""

    def after_a_step() -> tuple[int, float]:
        count = len(heights)
        _bar(user, "Step 1").click()
        user.until(lambda: len(heights) > count)
        return heights[-1]

    before = _run_on(user, heights)
    assert heights[-1][1] > HEIGHT + 0.1
    _choose(user, "Reset", "Reset poses only")
    time_ns, height = after_a_step()
    assert (time_ns, height) == (before + STEP_NS, pytest.approx(HEIGHT, abs=1e-4))
    _choose(user, "Reset", "Reset time only")
    time_ns, height = after_a_step()
    assert time_ns == STEP_NS
    for _ in range(9):
        after_a_step()
    user.page.keyboard.press("Shift+R")
    time_ns, height = after_a_step()
    assert (time_ns, height) == (STEP_NS, pytest.approx(HEIGHT, abs=1e-4))


@pytest.mark.slow
def test_a_joints_slider_moves_it(node: Node, user: SceneUser) -> None:
    angles: list[float] = []
    node.subscribe("/joint_states", "sensor_msgs/JointState", lambda m: angles.extend(m.position))
    user.page.get_by_role("treeitem").filter(has_text="balloon").first.click()
    _bar(user, "Play").click()
    user.until(lambda: angles)
    user.page.get_by_role("slider", name="hinge").press("PageUp")
    user.until(lambda: angles[-1] > 0.05)
    user.page.locator("aside").get_by_role("button", name="All to zero").click()
    user.until(lambda: abs(angles[-1]) < 0.01)
    _bar(user, "Pause").click()


@pytest.mark.slow
def test_the_timeline_seeks_back_and_runs_on(user: SceneUser, heights: Heights) -> None:
    before = _run_on(user, heights)
    user.open("Timeline")
    head = user.page.get_by_role("slider", name="Time")
    head.press("ArrowLeft")  # a second
    user.until(lambda: abs(float(head.get_attribute("aria-valuenow")) - before / 1e9 + 1.0) < 0.1)
    count = len(heights)
    _bar(user, "Step 1").click()
    user.until(lambda: len(heights) > count)
    assert heights[-1][0] == pytest.approx(before - 10**9, abs=0.1 * 10**9)
    earlier = dict(heights[:count])
    assert heights[-1][1] == earlier[heights[-1][0]]

    past = user.page.get_by_role("status").filter(has_text="past, ")
    past.get_by_text("past, 1.0 s ago").wait_for()
    user.button("Back to now").click()
    past.wait_for(state="detached")
    user.until(lambda: float(head.get_attribute("aria-valuenow")) == pytest.approx(before / 1e9, abs=0.01))
    head.press("ArrowLeft")
    count = len(heights)
    user.button("Resume here").click()
    user.until(lambda: heights[-1][0] > before)
    assert heights[count][0] < before
    _bar(user, "Pause").click()


@pytest.mark.slow
def test_the_worlds_tree_finds_shows_and_hides(user: SceneUser) -> None:
    """Selecting a link shows it in the inspector."""
    tree = user.page.get_by_role("tree", name="World")
    search = user.page.get_by_role("searchbox", name="Search the world")
    search.fill("hin")
    tree.get_by_role("treeitem").filter(has_text="arm").wait_for(state="detached")
    tree.get_by_role("treeitem").filter(has_text="hinge").wait_for()
    search.press("Escape")
    tree.get_by_role("treeitem").filter(has_text="arm").click()
    user.page.get_by_role("heading", name="arm", exact=True).wait_for()
    user.page.get_by_text("link of balloon").wait_for()
    tree.get_by_role("treeitem").filter(has_text="balloon").first.hover()
    user.button("Hide balloon").click()
    user.button("Show balloon").click()
    user.button("Hide balloon").wait_for()


@pytest.mark.slow
def test_a_recording_can_be_played(user: SceneUser, heights: Heights, folder: Path) -> None:
    before = _at_rest(user, heights)
    _bar(user, "Record").click()
    recording = user.page.get_by_role("banner").get_by_role("button", name="Recording")
    recording.wait_for()
    _bar(user, "Play").click()
    user.until(lambda: heights[-1][0] > before + 10**9)
    recording.click()
    _bar(user, "Record").wait_for()
    _bar(user, "Pause").click()
    user.open("Timeline")
    lane = user.page.get_by_role("group", name="Recorded", exact=True)
    kept_row = user.page.get_by_role("group", name="History", exact=True)
    assert 0 < lane.locator(".band").bounding_box()["width"] < kept_row.locator(".band").bounding_box()["width"]
    _at_rest(user, heights)

    [file] = folder.glob("recorded/*/state.log")
    log = read_state_log(file)
    assert log.times_s[0] == pytest.approx(before / 1e9, abs=1e-4)
    assert log.times_s[-1] - log.times_s[0] > 0.9
    assert log.links == ("balloon::base", "balloon::arm")


@pytest.mark.slow
def test_a_changed_world_is_reloaded(user: SceneUser, heights: Heights, folder: Path) -> None:
    """A broken file is refused with its line. Must be last."""
    (folder / "sky.sdf").write_text(_world('<model name="cloud"><pose>3 0 0 0 0 0</pose><link name="l"/></model>'))
    _choose(user, "Reset", "Load the world again")
    user.page.get_by_role("treeitem").filter(has_text="cloud").first.wait_for()
    (folder / "sky.sdf").write_text(_world("<model"))
    _choose(user, "Reset", "Load the world again")
    user.page.get_by_role("status").get_by_text("sky.sdf:5: error: not well-formed XML").wait_for()
    count = len(heights)
    _bar(user, "Step 1").click()
    user.until(lambda: len(heights) > count)
    assert heights[-1][0] == STEP_NS
