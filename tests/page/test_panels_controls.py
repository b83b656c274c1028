"""Panels with controls: steering, reconfigure, joints, joystick, timeline; plots and pictures."""

import math
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser

from trundle.base.http.page_address import PageAddress
from trundle.page import ClockState, GraphAddress, JointSlider, PageServer, Session, TimelineSpan
from trundle.ros import Node, Option, ReconfigureServer

pytestmark = needs_client

SESSION = Session(
    title="t",
    kind="graph",
    panels=("rqt_plot",),
    plots=("/wave/data",),
    images=("/pixels",),
    drive_topic="/cmd_vel",
    sliders=(JointSlider(name="arm", lower=-1.0, upper=1.0, position=0.5),),
    joystick=True,
)


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def node(graph: Graph) -> Node:
    return graph.node("tester")


@pytest.fixture(scope="module")
def server(graph: Graph, node: Node) -> Iterator[PageServer]:
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(SESSION, at=PageAddress(port=0), graph=address, node=node) as server:
        yield server


class Owner:
    """Answers requests of the user."""

    def __init__(self, graph: Graph, server: PageServer) -> None:
        self.graph, self.server = graph, server
        self.actions: list[Any] = []

    def next(self, kind: str) -> dict[str, Any]:
        """Wait for the next request, which must have this tag; return its fields."""
        self.graph.until(self._came)
        action = self.actions.pop(0)
        assert action.__struct_config__.tag == kind
        return {name: getattr(action, name) for name in action.__struct_fields__}

    def _came(self) -> bool:
        for request in self.server.requests():
            self.server.respond(request.id)
            self.actions.append(request.action)
        return bool(self.actions)


@pytest.fixture(scope="module")
def owner(graph: Graph, server: PageServer) -> Owner:
    return Owner(graph, server)


@pytest.fixture(scope="module")
def user(chromium: Any, server: PageServer) -> Iterator[PanelUser]:
    user = PanelUser(chromium, server.url)
    yield user
    user.close()


def test_holding_a_slider_steers_and_releasing_it_stops(graph: Graph, node: Node, user: PanelUser) -> None:
    received: list[tuple[float, float]] = []
    node.subscribe("/cmd_vel", "geometry_msgs/Twist", lambda m: received.append((m.linear.x, m.angular.z)))
    user.open("Steering")
    user.sees("Hold a slider to drive; let go to stop.")  # the topic is known
    slider = user.page.get_by_role("slider", name="Forward, v")
    slider.hover()  # waits until the panel is still
    box = slider.bounding_box()
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    user.page.mouse.move(middle[0] + box["width"] / 4, middle[1])
    user.page.mouse.down()
    try:  # half of the disc's limit, the sliders', too
        graph.until(lambda: len(received) >= 3 and all(0.15 < linear < 0.35 for linear, _ in received[-3:]))
    finally:
        user.page.mouse.up()
    graph.until(lambda: received[-1] == (0.0, 0.0))
    user.until_still(lambda: len(received))
    assert received[-2] != (0.0, 0.0)  # one stop is sent


@pytest.mark.slow
def test_options_of_a_node_are_changed_and_undone(graph: Graph, node: Node, user: PanelUser) -> None:
    options = [Option(name="rate", value=10.0, lower=1.0, upper=50.0), Option(name="on", value=False)]
    applied: list[dict[str, object]] = []

    def apply(values: dict[str, Any]) -> dict[str, Any]:
        applied.append(dict(values))
        return values

    reconfigure = ReconfigureServer(node, options, apply, namespace="/driver")
    user.open("Reconfigure")
    user.type("rate", "25")
    graph.until(lambda: applied and applied[-1]["rate"] == 25.0)
    user.page.get_by_role("checkbox", name="on").check()
    graph.until(lambda: applied[-1] == {"rate": 25.0, "on": True})
    user.page.keyboard.press("Control+z")
    graph.until(lambda: applied[-1] == {"rate": 25.0, "on": False})
    reconfigure.unregister()


@pytest.mark.slow
def test_joint_sliders_send_requests(owner: Owner, user: PanelUser) -> None:
    user.open("Joints")
    user.type("arm [rad]", "-0.25")
    assert owner.next("slider") == {"joint": "arm", "position": -0.25}
    user.button("All to zero").click()
    assert owner.next("slider") == {"joint": "arm", "position": 0.0}


@pytest.mark.slow
def test_holding_a_joystick_button_sends_it_pressed(owner: Owner, user: PanelUser) -> None:
    user.open("Joystick")
    user.page.get_by_role("button", name="X", exact=True).hover()
    user.page.mouse.down()
    assert owner.next("joystick")["buttons"][:4] == (0, 0, 1, 0)
    user.page.mouse.up()
    assert not any(owner.next("joystick")["buttons"])
    user.page.get_by_role("slider", name="Left stick").press("ArrowUp", delay=200)
    assert owner.next("joystick")["axes"][:2] == (0.0, 1.0)
    assert owner.next("joystick")["axes"][:2] == (0.0, 0.0)


@pytest.mark.slow
def test_a_plot_shows_numbers_and_saves_them(graph: Graph, node: Node, user: PanelUser) -> None:
    publisher = node.advertise("/wave", "std_msgs/Float64")
    user.open("Plots")
    graph.until(lambda: publisher.has_subscribers)
    wave = [math.sin(index / 10) for index in range(100)]
    for value in wave:
        publisher.publish({"data": value})
        time.sleep(0.005)
    publisher.publish({"data": 0.125})
    user.page.locator(".legend b", has_text="0.125").wait_for()
    with user.page.expect_download() as download:
        user.button("Save").click()
        user.page.get_by_role("menuitem", name="CSV").click()
    lines = download.value.path().read_text().splitlines()
    assert lines[0] == "time,/wave/data"
    values = [float(line.split(",")[1]) for line in lines[1:]]
    assert values[-1] == 0.125
    assert len(values) > 10  # a slow page drops some of a stream
    assert values == [value for value in (*wave, 0.125) if value in values]

    user.page.locator(".dockhost").get_by_role("button", name="Pause", exact=True).click()
    publisher.publish({"data": 0.75})
    user.page.wait_for_timeout(500)
    assert user.page.locator(".legend b", has_text="0.750").count() == 0
    user.page.locator(".dockhost").get_by_role("button", name="Go on", exact=True).click()
    user.page.locator(".legend b", has_text="0.750").wait_for()
    publisher.unregister()


@pytest.mark.slow
def test_a_picture_shows_pixels_and_their_values(graph: Graph, node: Node, user: PanelUser) -> None:
    publisher = node.advertise("/pixels", "sensor_msgs/Image", latch=True)
    user.open("Images")
    graph.until(lambda: publisher.has_subscribers)
    pixels = np.zeros((2, 2, 3), np.uint8)
    pixels[0, 0] = (250, 10, 20)
    image = {"width": 2, "height": 2, "step": 6, "encoding": "rgb8", "data": pixels.tobytes()}
    publisher.publish(image)
    picture = user.page.get_by_role("img", name="Picture of /pixels")
    picture.wait_for()
    user.page.get_by_label("Zoom of /pixels").select_option("800 %")
    picture.hover(position={"x": 4, "y": 4})
    user.sees("0, 0: r 250 g 10 b 20")
    with user.page.expect_download() as download:
        user.button("Save /pixels as PNG").click()
    from PIL import Image

    assert Image.open(download.value.path()).convert("RGB").getpixel((0, 0)) == (250, 10, 20)
    publisher.unregister()


@pytest.mark.slow
def test_pictures_are_side_by_side_and_one_is_enlarged(graph: Graph, node: Node, user: PanelUser) -> None:
    left, right = (node.advertise(topic, "sensor_msgs/Image", latch=True) for topic in ("/pixels", "/more_pixels"))
    for publisher in (left, right):
        publisher.publish({"width": 2, "height": 2, "step": 6, "encoding": "rgb8", "data": bytes(12)})
    user.open("Images")
    user.button("Picture").click()
    user.page.get_by_role("menuitem", name="/more_pixels", exact=True).click()
    pictures = [user.page.get_by_role("img", name=f"Picture of {topic}") for topic in ("/pixels", "/more_pixels")]
    for picture in pictures:
        picture.wait_for()
    user.page.get_by_label("Zoom of /pixels").select_option("Fit")
    boxes = [picture.bounding_box() for picture in pictures]
    assert boxes[0]["x"] + boxes[0]["width"] <= boxes[1]["x"]
    assert boxes[0]["y"] == pytest.approx(boxes[1]["y"], abs=1)

    user.button("Enlarge /more_pixels").click()
    pictures[0].wait_for(state="detached")
    assert pictures[1].bounding_box()["width"] >= boxes[1]["width"]

    user.button("Show /more_pixels beside the others").click()
    pictures[0].wait_for()
    user.button("Close /more_pixels").click()
    pictures[1].wait_for(state="detached")
    for publisher in (left, right):
        publisher.unregister()


@pytest.mark.slow
def test_a_recording_is_played_and_scrubbed(owner: Owner, user: PanelUser) -> None:
    owner.server.put_state(ClockState(time_ns=2 * 10**9, paused=True, speed=1.0, timeline=TimelineSpan(0, 10 * 10**9)))
    user.open("Timeline")
    head = user.page.get_by_role("slider", name="Time")
    head.wait_for()
    assert head.get_attribute("aria-valuetext") == "0:02.00"
    ruler = user.page.locator(".headarea").bounding_box()
    user.page.mouse.click(ruler["x"] + ruler["width"] / 2, ruler["y"] + 10)
    assert abs(owner.next("seek")["time_ns"] / 1e9 - 5.0) < 0.1
    marks = user.page.get_by_role("group", name="Marks").bounding_box()
    user.page.mouse.move(marks["x"] + 0.3 * marks["width"], marks["y"] + 12)
    assert user.page.locator(".pointed").inner_text().startswith(("0:02.9", "0:03.0"))
    user.page.mouse.click(marks["x"] + 0.7 * marks["width"], marks["y"] + 12)
    assert abs(owner.next("seek")["time_ns"] / 1e9 - 7.0) < 0.1
    user.page.locator(".dockhost").get_by_role("button", name="Play", exact=True).click()
    assert owner.next("play") == {}
