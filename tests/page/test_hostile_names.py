"""Names and texts of an attacker on the page: they are always shown as text."""

import os
import subprocess
import sys
import time
import xmlrpc.client
from collections.abc import Iterator
from contextlib import suppress
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.page.scene_user import rviz_text
from tests.system.browser import running_page

from trundle.base.http.page_address import PageAddress
from trundle.page import TERMINAL, GraphAddress, JointSlider, NodeTerminal, PageServer, RvizFile, Session
from trundle.ros import Node

pytestmark = [needs_client, pytest.mark.slow]
RUN = "window.ran=1"
EVIL = {
    "markup": f"<img src=x onerror={RUN}>",
    "script": f"</title></script><script>{RUN}</script>",
    "quotes": f"\"'`onmouseover={RUN} x='",
    "link": f"javascript:{RUN}",
    "direction": "a\u202etxt.exe\u200b\u2066\u200d",
    "format": "%s${x}{{constructor}}\\u003cimg src=x onerror=1\\u003e",
    "proto": "__proto__",
    "constructor": "constructor",
    "long": "w" * 10_000,
}

TEXTS = {**EVIL, "controls": "a\x1b]0;evil\x07\x1b[31m\x08\x01\x7f\x9d0;evil\x9c"}
"""Texts in places where control characters are possible."""
PANELS = {
    "Plots": EVIL["markup"],
    "Topics": "/__proto__",
    "Log": EVIL["markup"],
    "Graph": "/n__proto__",
    "Timeline": "/rosout",
    "Performance": EVIL["markup"],
    "Compare": EVIL["markup"],
    "Navigation": EVIL["markup"],
    "Images": "/image",
    "Nodes": "/n__proto__",
    "Services": "/constructor",
    "Parameters": EVIL["markup"],
    "TF tree": EVIL["markup"],
    "Reconfigure": EVIL["markup"],
    "Joints": EVIL["markup"],
    "Steering": "Topic",
    "Joystick": "",
    "Terminal": "",
    "MotionPlanning": "No arm is planned here",
}
"""Panels of the dock, and a text that each shows."""
SESSION_PANELS = {
    "Plots": EVIL["markup"],
    "Images": EVIL["markup"],
    "Joints": EVIL["script"],
    "Joystick": "Left stick",
    "Steering": "Topic",
    "Terminal": EVIL["markup"],
}
"""Panels that a page's session fills, and a text that each shows."""
PANEL_MS = 60_000
"""Limit of each step in a panel."""
_ROWS = ".dockhost :is(tbody tr, .logrow, [role=treeitem], [role=tab], .offer, svg .box, summary)"


def _world() -> str:
    """Return a world in which everything has a hostile name."""
    models = "".join(
        f"<model name={quoteattr(name)}><pose>{i} 0 0.5 0 0 0</pose><link name={quoteattr(name)}>"
        f"<visual name={quoteattr(name)}><geometry><box><size>0.3 0.3 0.3</size></box></geometry></visual>"
        f"<sensor name={quoteattr(name)} type='altimeter'><update_rate>10</update_rate></sensor></link>"
        f"<link name='b'/><joint name={quoteattr(name)} type='revolute'><parent>{_text(name)}</parent><child>b</child>"
        f"<axis><xyz>0 0 1</xyz></axis></joint>"
        f"<plugin name={quoteattr(name)} filename={quoteattr(name)}><value>{_text(name)}</value></plugin>"
        f"<plugin name={quoteattr(name)} filename='libgazebo_ros_p3d.so'><bodyName>b</bodyName>"
        f"<topicName>/pose_{i}</topicName><updateRate>10</updateRate></plugin></model>"
        f"<light name={quoteattr(name)} type='point'/>"
        for i, name in enumerate(EVIL.values())
    )
    return f"<sdf version='1.6'><world name={quoteattr(EVIL['markup'])}>{models}</world></sdf>"


def _text(name: str) -> str:
    return quoteattr(name)[1:-1]


def _register(uri: str) -> None:
    """Register hostile names of nodes, topics, types, services and parameters at the master; it may refuse them."""
    with xmlrpc.client.ServerProxy(uri) as master:
        for kind, name in EVIL.items():
            calls = (
                ("registerPublisher", f"/n{name}", f"/t{name}", f"p/{name}", "http://127.0.0.1:9/"),
                ("registerPublisher", f"/{kind}", f"/{kind}", name, f"http://127.0.0.1:9/{name}"),
                ("registerSubscriber", f"/n{name}", f"/t{name}", "*", "http://127.0.0.1:9/"),
                ("registerService", f"/n{name}", f"/s{name}", "rosrpc://127.0.0.1:9", "http://127.0.0.1:9/"),
                ("setParam", "/evil", f"/p{name}", name),
                ("setParam", "/evil", f"/texts/{kind}", {kind: [name], name: name}),
            )
            for method, *words in calls:
                with suppress(xmlrpc.client.Fault):
                    getattr(master, method)(*words)


class Attacker:
    """Node whose messages are hostile."""

    def __init__(self, node: Node) -> None:
        advertise = node.advertise
        self._topics = [
            (advertise("/rosout", "rosgraph_msgs/Log"), self._log),
            (advertise("/tf", "tf2_msgs/TFMessage"), self._transform),
            (advertise("/text", "std_msgs/String"), lambda name: {"data": name}),
            (advertise("/__proto__", "std_msgs/String"), lambda name: {"data": name}),
            (advertise("/attacker/parameter_descriptions", "dynamic_reconfigure/ConfigDescription"), self._options),
            (advertise("/attacker/parameter_updates", "dynamic_reconfigure/Config"), lambda _: self._values()),
            (advertise("/joint_states", "sensor_msgs/JointState"), lambda name: {"name": [name], "position": [0.5]}),
            (advertise("/marker", "visualization_msgs/Marker"), self._marker),
            (advertise("/diagnostics", "diagnostic_msgs/DiagnosticArray"), self._diagnostics),
            (advertise("/image", "sensor_msgs/Image"), lambda name: {"header": {"frame_id": name}, "encoding": name}),
            (advertise("/move_base/feedback", "move_base_msgs/MoveBaseActionFeedback"), lambda _: {}),
            (advertise("/move_base/status", "actionlib_msgs/GoalStatusArray"), self._goals),
            (advertise("/move_base/recovery_status", "move_base_msgs/RecoveryStatus"), self._recovery),
            (advertise("/cloud", "sensor_msgs/PointCloud2"), lambda name: {"fields": [{"name": name, "count": 1}]}),
        ]

        node.advertise_service("/constructor", "std_srvs/Trigger", lambda _: {"message": EVIL["markup"]})
        node.subscribe("/constructor", "geometry_msgs/Twist", lambda _: None)

    def speak(self) -> None:
        for name in TEXTS.values():
            for publisher, message in self._topics:
                publisher.publish(message(name))

    @staticmethod
    def _options(_: str) -> dict[str, Any]:
        options = [
            {"name": name, "type": "str", "description": name, "edit_method": f"{{'enum': [{name!r}]}}"}
            for name in TEXTS.values()
        ]
        return {"groups": [{"name": EVIL["markup"], "type": EVIL["script"], "parameters": options}]}

    @staticmethod
    def _values() -> dict[str, Any]:
        return {"strs": [{"name": name, "value": name} for name in TEXTS.values()]}

    @staticmethod
    def _log(name: str) -> dict[str, Any]:
        return {"level": 8, "name": name, "msg": name, "file": name, "function": name, "topics": [name]}

    @staticmethod
    def _transform(name: str) -> dict[str, Any]:
        pose = {"rotation": {"w": 1.0}}
        stamp = {"secs": int(time.time())}
        return {
            "transforms": [{"header": {"frame_id": "world", "stamp": stamp}, "child_frame_id": name, "transform": pose}]
        }

    @staticmethod
    def _marker(name: str) -> dict[str, Any]:
        white, size = {"r": 1.0, "g": 1.0, "b": 1.0, "a": 1.0}, {"x": 1.0, "y": 1.0, "z": 0.2}
        pose = {"orientation": {"w": 1.0}}
        header = {"frame_id": "world"}
        return {"header": header, "ns": name, "type": 9, "text": name, "scale": size, "color": white, "pose": pose}

    @staticmethod
    def _goals(name: str) -> dict[str, Any]:
        return {"status_list": [{"goal_id": {"id": name}, "status": 200, "text": name}]}

    @staticmethod
    def _recovery(name: str) -> dict[str, Any]:
        return {"recovery_behavior_name": name, "current_recovery_number": 9, "total_number_of_recoveries": 1}

    @staticmethod
    def _diagnostics(name: str) -> dict[str, Any]:
        values = [{"key": name, "value": name}]
        return {"status": [{"level": 2, "name": name, "message": name, "hardware_id": name, "values": values}]}


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def url(graph: Graph, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder: Path = tmp_path_factory.mktemp("evil")
    (folder / "world.sdf").write_text(_world())
    _register(graph.core.uri)
    environment = {"HOME": str(folder), "ROS_MASTER_URI": graph.core.uri}
    log = f"{EVIL['markup']}.log"
    words = [sys.executable, "-m", "trundle", "run", "world.sdf", "--headless", "--duration", "0.1", "--record", log]
    subprocess.run([*words, "--no-ros"], cwd=folder, env={**os.environ, **environment}, check=True, timeout=300)
    words = ["run", "world.sdf", "--port", "0", "--compare", log]
    with running_page(*words, environment=environment, folder=folder) as url:
        yield url


@pytest.fixture(scope="module")
def session_url(graph: Graph) -> Iterator[str]:
    """Page whose session has hostile texts."""
    texts = tuple(TEXTS.values())
    session = Session(
        title=EVIL["markup"],
        kind="graph",
        robot=EVIL["script"],
        rviz=RvizFile(name=f"{EVIL['markup']}.rviz", text=rviz_text(), writable=True),
        fixed_frame=EVIL["markup"],
        namespace=EVIL["quotes"],
        remappings={EVIL["proto"]: EVIL["markup"]},
        panels=texts,
        plots=tuple(f"/{text}/data" for text in texts),
        images=texts,
        drive_topic="/constructor",
        sliders=tuple(JointSlider(name=text, lower=-1.0, upper=1.0, position=0.0) for text in texts),
        joystick=True,
        terminals=tuple(NodeTerminal(name=text, ended=text) for text in texts),
    )
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(session, at=PageAddress(port=0), graph=address) as server:
        for number in range(len(texts)):
            server.put_terminal(f"{TERMINAL}{number}", 0, (80, 24), "\r\n".join(texts).encode())
        yield server.url


class Victim(PanelUser):
    """User who opens everything; records scripts that ran, or would have run without a policy."""

    def __init__(self, browser: Any, url: str) -> None:
        self.complaints: list[str] = []
        super().__init__(browser, url)
        self.page.on("console", self._hear)
        self.page.on("dialog", lambda dialog: self.complaints.append(f"dialog: {dialog.message}") or dialog.dismiss())

    def _note(self, error: Any) -> None:
        self.faults.append(f"{error}\n{error.stack}")

    def _hear(self, message: Any) -> None:
        if "Content Security Policy" in message.text:
            self.complaints.append(message.text)

    def check(self, state: str) -> None:
        self.page.wait_for_timeout(300)
        assert self.page.evaluate("window.ran === undefined && Object.prototype.data === undefined"), state
        elements = self.page.evaluate(
            "document.querySelectorAll('img[src=x], script:not([src]), [onmouseover]').length"
        )
        assert (elements, self.complaints, self.faults) == (0, [], []), state
        assert self.page.evaluate("document.documentElement.scrollWidth <= innerWidth"), f"{state} is too wide"

    def look_around(self) -> None:
        """Hover over the entries of the front panel, and click them."""
        for row in self.page.locator(_ROWS).all()[:8]:
            with suppress(Exception):  # the list may change meanwhile
                row.hover(timeout=500)
                row.click(timeout=500)

    def unfold(self) -> None:
        """Show what the front panel folds."""
        for fold in self.page.locator(".dockhost .fold[aria-expanded=false]").all():
            fold.click()

    def side(self, name: str) -> None:
        tab = self.page.get_by_role("tab", name=name, exact=True)
        (tab if tab.count() else self.page.locator(".rail").get_by_role("button", name=name)).first.click()


def test_hostile_names_run_nothing_when_their_objects_are_used(chromium: Any, graph: Graph, url: str) -> None:
    """Selecting, hovering, menus, searching commands, displays and their statuses, an .rviz file."""
    attacker = Attacker(graph.node("attacker_again"))
    user = Victim(chromium, url)
    user.side("World")
    for name in EVIL.values():
        row = user.page.get_by_role("treeitem").filter(has_text=name[:40]).first
        if row.count() == 0:
            continue
        row.click()
        row.hover()
        user.check(f"selected: {name[:40]}")
        row.click(button="right")
        user.check(f"the menu of {name[:40]}")
        user.page.keyboard.press("Escape")
    user.page.keyboard.press("Control+k")
    user.page.get_by_role("combobox", name="Search commands").fill("img")
    user.check("the search of commands")
    user.page.keyboard.press("Escape")
    displays = [
        {
            "Class": kind,
            "Name": name,
            "Enabled": True,
            "Topic": name,
            "Marker Topic": "/marker",
            "Image Topic": "/image",
        }
        for name in EVIL.values()
        for kind in ("rviz/Marker", "rviz/Image", "rviz/LaserScan", name)
    ]
    user.drop_file(f"{EVIL['markup']}.rviz", rviz_text(*displays))
    user.side("Displays")
    for _ in range(3):
        attacker.speak()
        user.check("displays of a hostile file")
    for row in user.page.get_by_role("treeitem").all()[:40]:
        with suppress(Exception):
            row.press("ArrowRight", timeout=1000)
    user.check("displays that are open")
    user.close()


def _visit(user: Victim, attacker: Attacker, panel: str, text: str) -> None:
    """Open a panel, wait until it shows the attacker's text, and use its entries."""
    user.page.set_default_timeout(PANEL_MS)
    user.open(panel)
    if panel == "Plots":
        user.button("Add curve").click()
    end = time.monotonic() + PANEL_MS / 1000
    while text not in user.page.locator(".dockhost").inner_text().replace("\n", ""):  # long names are in two parts
        user.unfold()
        assert time.monotonic() < end, f"{panel} does not show {text!r}: {user.page.inner_text('.dockhost')[:2000]}"
        attacker.speak()
        user.page.wait_for_timeout(200)
    user.check(panel)
    user.look_around()
    attacker.speak()
    user.check(f"{panel}, handled")


@pytest.fixture(scope="module")
def attacker(graph: Graph) -> Attacker:
    node = graph.node("attacker")
    attacker = Attacker(node)
    graph.ready(node)
    return attacker


@pytest.mark.parametrize("panel", PANELS)
def test_hostile_texts_run_nothing_in_a_panel(chromium: Any, attacker: Attacker, url: str, panel: str) -> None:
    user = Victim(chromium, url)
    _visit(user, attacker, panel, PANELS[panel])
    user.close()


@pytest.mark.parametrize("panel", SESSION_PANELS)
def test_hostile_texts_of_a_session_run_nothing_in_a_panel(
    chromium: Any, attacker: Attacker, session_url: str, panel: str
) -> None:
    user = Victim(chromium, session_url)
    _visit(user, attacker, panel, SESSION_PANELS[panel])
    user.close()


def _arm() -> tuple[str, str]:
    """Return URDF and SRDF of an arm in which everything has a hostile name."""
    names = [quoteattr(name) for name in EVIL.values()]
    links = "".join(f"<link name={name}/>" for name in names)
    joints = "".join(
        f"<joint name={child} type='revolute'><parent link={parent}/><child link={child}/><axis xyz='0 0 1'/>"
        f"<limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
        for parent, child in pairwise(names)
    )
    groups = "".join(
        f"<group name={name}>{''.join(f'<joint name={joint}/>' for joint in names[1:])}</group>"
        f"<group_state name={name} group={names[0]}><joint name={names[1]} value='0.5'/></group_state>"
        for name in names
    )
    return f"<robot name={names[0]}>{links}{joints}</robot>", f"<robot name={names[0]}>{groups}</robot>"


@pytest.fixture(scope="module")
def arm_url() -> Iterator[str]:
    """Page of a graph with a move_group whose robot, objects and planners have hostile names."""
    with running_graph() as graph:
        with xmlrpc.client.ServerProxy(graph.core.uri) as master:
            for suffix, text in zip(("", "_semantic"), _arm(), strict=True):
                master.setParam("/evil", f"/robot_description{suffix}", text)
        node = graph.node("evil_arm")
        node.advertise("/move_group/result", "moveit_msgs/MoveGroupActionResult")
        scene = node.advertise("/move_group/monitored_planning_scene", "moveit_msgs/PlanningScene", latch=True)
        pose, ball = {"orientation": {"w": 1.0}}, {"type": 2, "dimensions": [0.1]}
        objects = [
            {"id": name, "header": {"frame_id": EVIL["markup"]}, "primitives": [ball], "primitive_poses": [pose]}
            for name in TEXTS.values()
        ]
        held = [{"link_name": one["id"], "object": {**one, "id": f"held {one['id']}"}} for one in objects]
        state = {"attached_collision_objects": held}
        planners = [{"name": name, "pipeline_id": name, "planner_ids": list(TEXTS.values())} for name in TEXTS.values()]
        node.advertise_service(
            "/query_planner_interface",
            "moveit_msgs/QueryPlannerInterfaces",
            lambda _: {"planner_interfaces": planners},
        )
        scene.publish({"name": EVIL["markup"], "world": {"collision_objects": objects}, "robot_state": state})
        graph.ready(node)
        session = Session(title="arm", kind="graph")
        address = GraphAddress(master_uri=graph.core.uri)
        with PageServer.start(session, at=PageAddress(port=0), graph=address) as server:
            yield server.url


def test_hostile_names_of_an_arm_run_nothing(chromium: Any, arm_url: str) -> None:
    user = Victim(chromium, arm_url)
    user.page.set_default_timeout(PANEL_MS)
    user.button("Add MotionPlanning").click()
    panel = user.page.locator(".motionplanning")
    for section, text in (
        ("Planning", "script"),
        ("Joints", "script"),
        ("Scene Objects", "markup"),
        ("Context", "link"),
    ):
        user.open("MotionPlanning")  # looking around leads to other panels
        panel.get_by_role("tab", name=section, exact=True).click()
        user.until(lambda expected=EVIL[text]: expected in panel.inner_text().replace("\n", ""), what=section)
        user.look_around()
        user.check(section)
    user.close()


def test_every_panel_is_tested(chromium: Any, session_url: str) -> None:
    user = Victim(chromium, session_url)
    titles = set(user.page.locator(".dv-tab").all_inner_texts())
    user.button("Open a panel").click()
    titles |= set(user.page.get_by_role("menuitem").all_inner_texts())

    assert {title.strip() for title in titles} == set(PANELS)
    user.close()


@pytest.mark.parametrize(
    ("page", "side"),
    [("url", "World"), ("url", "Displays"), ("url", "Inspector"), ("url", "Views"), ("session_url", "Tool properties")],
)
def test_hostile_texts_run_nothing_in_side_panels(
    request: pytest.FixtureRequest, chromium: Any, attacker: Attacker, page: str, side: str
) -> None:
    user = Victim(chromium, request.getfixturevalue(page))
    user.page.set_default_timeout(PANEL_MS)
    user.side(side)
    attacker.speak()
    user.check(side)
    user.close()


def test_injected_markup_is_detected(chromium: Any, session_url: str) -> None:
    """Shows that the checks above can fail."""
    user = Victim(chromium, session_url)
    user.check("untouched")
    user.page.evaluate("(markup) => document.body.insertAdjacentHTML('beforeend', markup)", EVIL["markup"])

    with pytest.raises(AssertionError, match="with markup of the attacker"):
        user.check("with markup of the attacker")
    user.close()
