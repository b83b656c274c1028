"""Twelve tasks of rviz's user guide and Gazebo's tutorials, each in a fresh profile, in no more actions than there.

An action is a click, a drag, or a field that is typed into. The world and the graph are looked at from above first,
which does not count.
"""

import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import SceneUser, rviz_text
from tests.page.world_user import WorldUser
from tests.recorded_drives import MESSAGES, transform
from tests.system.browser import running_page

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, RvizFile, Session

pytestmark = [pytest.mark.slow, needs_client]

ORIGINAL = {
    # rviz's user guide, "Adding a new display": the button Add; in its dialog the tab "By topic", the display, OK.
    "add a display by topic": 4,
    # The same, "The Fixed Frame", a property in the list of displays: type its value.
    "change the fixed frame": 1,
    # The same, "2D Nav Goal": the tool, a drag from the place to the direction.
    "set a navigation goal": 2,
    # The same, "2D Pose Estimate": as the goal.
    "set the initial pose": 2,
    # The status line of rviz's tool Measure: the tool, two points.
    "measure a distance": 3,
    # rqt's menus: Plugins, Visualization, TF Tree.
    "show the tree of tf": 3,
    # Gazebo's tutorial "Building a world" (build_world), "Adding Simple Shapes": the box' icon, a click into the scene.
    "insert a box": 2,
    # The same, "Translation": the tool, a drag of the object.
    "move a model": 2,
    # Gazebo's tutorial "User Interface" (guided_b2), "Bottom Toolbar": the button pause, the button step.
    "pause and step": 2,
    # Gazebo's tutorial "Apply Force and Torque via GUI" (apply_force_torque), on the box: a right click, Apply
    # Force/Torque, a force typed into X, with Enter.
    "apply a force": 3,
    # Gazebo's tutorial "Modifying a world" (modifying_world), "Physics Properties", in the tab World, which is open:
    # the item physics, its block gravity, a number typed into z.
    "change gravity": 3,
    # Gazebo's tutorial "Torsional friction" (torsional_friction): the menu View, Contacts.
    "view contacts": 2,
}
"""Task → actions in rviz, rqt or Gazebo."""

LISTENED = {
    "/initialpose": "geometry_msgs/PoseWithCovarianceStamped",
    "/move_base_simple/goal": "geometry_msgs/PoseStamped",
}


def _box(name: str, pose: str, size: str, *, static: bool = False) -> str:
    shape = f"<geometry><box><size>{size}</size></box></geometry>"
    link = f'<link name="base"><collision name="c">{shape}</collision><visual name="v">{shape}</visual></link>'
    return f'<model name="{name}"><static>{int(static)}</static><pose>{pose}</pose>{link}</model>'


WORLD = f"""<sdf version="1.6"><world name="yard">{_box("floor", "0 0 -0.1 0 0 0", "20 20 0.2", static=True)}
{_box("crate", "-1 0 0.2 0 0 0", "0.4 0.4 0.4")}{_box("drum", "1 0.5 0.2 0 0 0", "0.4 0.4 0.4")}</world></sdf>"""


class Actions:
    """Acts on a page, and counts."""

    def __init__(self, user: SceneUser) -> None:
        self.user = user
        self.count = 0

    def click(self, target: Any) -> None:
        """Click an element."""
        self.count += 1
        target.click()

    def press(self, name: str, *, within: str = "body") -> None:
        """Click a button."""
        self.click(self.user.page.locator(within).get_by_role("button", name=name, exact=True).first)

    def choose(self, name: str, *, role: str = "menuitem") -> None:
        """Click an entry of a menu."""
        self.click(self.user.page.get_by_role(role, name=name, exact=True))

    def tool(self, name: str) -> None:
        self.click(self.user.page.get_by_role("toolbar", name="Tools").get_by_role("button", name=name, exact=True))

    def click_scene(self, x: float, y: float, *, button: str = "left") -> None:
        """Click a point of the ground [m]."""
        self.count += 1
        self.user.click((x, y), button=button)

    def drag(self, *points: tuple[float, float]) -> None:
        """Drag in the scene over points of the ground [m]."""
        self.count += 1
        self.user.drag(*points)

    def drag_from(self, entry: Any, point: tuple[float, float]) -> None:
        """Drag an entry of a panel to a point of the ground [m]."""
        self.count += 1
        box = entry.bounding_box()
        mouse = self.user.page.mouse
        mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        mouse.down()
        mouse.move(*self.user.at(point), steps=4)
        mouse.up()

    def type(self, field: Any, text: str) -> None:
        """Type into a field, and press Enter."""
        self.count += 1
        field.fill(text)
        field.press("Enter")

    def check(self, task: str, done: Callable[[], object]) -> None:
        """Wait until a task is done; its actions are no more than the original's."""
        self.user.until(done, what=f"to {task}")
        assert self.count <= ORIGINAL[task], f"{task}: {self.count} actions"
        self.user.close()


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def received(graph: Graph) -> dict[str, list[Any]]:
    """Messages of the tools, while a robot stands at the origin."""
    node = graph.node("tester")
    messages: dict[str, list[Any]] = {topic: [] for topic in LISTENED}
    for topic, kind in LISTENED.items():
        node.subscribe(topic, kind, messages[topic].append)
    frames = {"transforms": [transform("map", "odom"), transform("odom", "base_link")]}
    node.advertise("/tf_static", "tf2_msgs/TFMessage", latch=True).publish(MESSAGES.new("tf2_msgs/TFMessage", frames))
    scan = {"header": {"frame_id": "base_link"}, "angle_increment": 1.5, "range_max": 9.0, "ranges": [0.5, 1.0]}
    node.advertise("/scan", "sensor_msgs/LaserScan", latch=True).publish(scan)
    graph.ready(node)
    return messages


@pytest.fixture(scope="module")
def graph_page(graph: Graph, received: dict[str, list[Any]]) -> Iterator[str]:
    session = Session(title="t", kind="graph", rviz=RvizFile(name="t.rviz", text=rviz_text(), writable=False))
    with PageServer.start(session, at=PageAddress(port=0), graph=GraphAddress(master_uri=graph.core.uri)) as server:
        yield server.url


@pytest.fixture
def rviz(chromium: Any, graph_page: str) -> Actions:
    return Actions(SceneUser(chromium, graph_page))


@pytest.fixture(scope="module")
def world_page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--no-ros", "--port", "0")
    with running_page(*words, environment={"HOME": str(folder)}, folder=folder) as url:
        yield url


@pytest.fixture
def gazebo(chromium: Any, world_page: str) -> Actions:
    user = WorldUser(chromium, world_page)
    user.look_down()
    return Actions(user)


def world_of(gazebo: Actions) -> WorldUser:
    assert isinstance(gazebo.user, WorldUser)
    return gazebo.user


def test_a_display_is_added_by_topic(rviz: Actions) -> None:
    page = rviz.user.page
    rviz.press("Add")
    rviz.click(page.locator("div").filter(has_text="/scan").get_by_role("button", name="Show").last)
    rviz.check("add a display by topic", lambda: rviz.user.sees_at((0.5, 0.0)))


def test_the_fixed_frame_is_changed(rviz: Actions) -> None:
    rviz.type(rviz.user.property("Fixed Frame"), "base_link")
    rviz.check("change the fixed frame", lambda: rviz.user.property("Fixed Frame").input_value() == "base_link")


def test_a_goal_is_set(rviz: Actions, received: dict[str, list[Any]]) -> None:
    rviz.tool("2D Nav Goal")
    rviz.drag((-1.0, -1.0), (-1.5, -1.0))
    rviz.check("set a navigation goal", lambda: received["/move_base_simple/goal"])


def test_the_initial_pose_is_set(rviz: Actions, received: dict[str, list[Any]]) -> None:
    rviz.tool("2D Pose Estimate")
    rviz.drag((1.0, -1.0), (1.0, -0.4))
    rviz.check("set the initial pose", lambda: received["/initialpose"])


def test_a_distance_is_measured(rviz: Actions) -> None:
    rviz.tool("Measure")
    rviz.click_scene(1.0, -0.5)
    rviz.click_scene(1.0, -1.25)
    rviz.check("measure a distance", lambda: rviz.user.page.get_by_role("status").get_by_text("0.750 m").count())


def test_the_tree_of_tf_is_shown(rviz: Actions) -> None:
    rviz.press("Open a panel")
    rviz.choose("TF tree")
    rviz.check("show the tree of tf", lambda: rviz.user.page.locator(".dockhost").get_by_text("base_link").count())


def test_a_box_is_inserted(gazebo: Actions) -> None:
    gazebo.click(gazebo.user.page.get_by_role("tab", name="Insert"))
    gazebo.drag_from(gazebo.user.page.get_by_role("button", name="Insert box", exact=True), (0.0, -1.0))
    gazebo.check("insert a box", lambda: world_of(gazebo).model("box"))


def test_a_model_is_moved(gazebo: Actions) -> None:
    user = world_of(gazebo)
    before = user.position("drum")
    gazebo.tool("Move")
    gazebo.drag((1.0, 0.5), (1.3, 0.8), (1.6, 1.0))
    gazebo.check("move a model", lambda: math.dist(before, user.position("drum")) > 0.3)


def test_time_is_paused_and_stepped(gazebo: Actions) -> None:
    user = world_of(gazebo)
    gazebo.press("Pause", within="header")
    user.until(lambda: user.is_paused)
    paused_ns = user.state["time_ns"]
    gazebo.press("Step 1", within="header")
    gazebo.user.until(lambda: user.state["time_ns"] > paused_ns, what="for the step")
    user.page.get_by_role("banner").get_by_role("button", name="Play", exact=True).click()  # for the next test
    gazebo.check("pause and step", lambda: not user.is_paused)


def test_a_force_is_applied(gazebo: Actions) -> None:
    user = world_of(gazebo)
    before = user.position("crate")
    gazebo.click_scene(-1.0, 0.0, button="right")
    gazebo.choose("Apply force or torque…")
    gazebo.type(user.field("force x"), "-60")
    gazebo.check("apply a force", lambda: user.position("crate")[0] < before[0] - 0.05)


def test_gravity_is_changed(gazebo: Actions) -> None:
    user = world_of(gazebo)
    gazebo.click(user.page.get_by_role("treeitem").get_by_text("yard", exact=True).first)
    gazebo.type(user.field("gravity z"), "-2.5")
    gazebo.check("change gravity", lambda: user.manifest()["physics"]["gravity"] == [0.0, 0.0, -2.5])


def test_contacts_are_viewed(gazebo: Actions) -> None:
    gazebo.press("Show in the view")
    entry = gazebo.user.page.get_by_role("menuitemcheckbox", name="Contacts", exact=True)
    gazebo.click(entry)
    gazebo.check("view contacts", lambda: entry.count() == 0 or entry.get_attribute("aria-checked") == "true")
