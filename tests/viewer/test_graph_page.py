"""The page of a real graph in a real browser: a robot on tf, images, sliders, and a pad that drives."""

import io
import queue
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from trundle.diagnostics import Diagnostics
from trundle.packages import Packages
from trundle.ros import (
    Core,
    GraphLoop,
    Message,
    Node,
    Option,
    Options,
    ReconfigureServer,
    Transform,
    TransformBroadcaster,
)
from trundle.viewer import GraphPage

pytestmark = [pytest.mark.browser, pytest.mark.slow]

_PATIENCE_S = 60.0
_URDF = """\
<robot name="bluecar">
  <link name="base_link">
    <visual>
      <geometry><box size="0.5 0.3 0.15"/></geometry>
      <material name="blue"><color rgba="0 0 0.9 1"/></material>
    </visual>
  </link>
</robot>
"""
_CONFIG = """\
Visualization Manager:
  Displays:
    - Class: rviz/RobotModel
    - Class: rviz/Image
      Image Topic: /camera/image_raw
  Global Options:
    Fixed Frame: odom
"""


@dataclass(frozen=True)
class Slider:
    name: str
    lower: float
    upper: float
    position: float


@dataclass(frozen=True)
class Scenery:
    loop: GraphLoop
    robot: Node
    page: GraphPage
    shown: "Future[int]"
    report: Diagnostics


@pytest.fixture
def scenery(tmp_path: Path) -> Iterator[Scenery]:
    """Start a master, a robot's node and a page that shows the graph."""
    config, report = tmp_path / "car.rviz", Diagnostics()
    config.write_text(_CONFIG)
    with GraphLoop() as loop:
        core = Core(loop=loop, port=0)
        loop.run(core.start())
        robot = Node("robot", loop=loop, master_uri=core.uri)
        loop.run(robot.params.set("/robot_description", _URDF))
        rviz = Node("rviz", loop=loop, master_uri=core.uri)
        said: list[str] = []
        page = GraphPage(packages=Packages({}, start=tmp_path), report=report, say=said.append, port=0)
        shown = loop.spawn(page.show(rviz, config=str(config)))
        deadline = time.monotonic() + _PATIENCE_S
        while page.url is None:
            assert not shown.done(), shown.exception()
            assert time.monotonic() < deadline
            time.sleep(0.02)
        assert said == [f"see it at {page.url}"]
        yield Scenery(loop, robot, page, shown, report)
        page.close()
        loop.run(rviz.shutdown())
        loop.run(robot.shutdown())
        loop.run(core.stop())


@pytest.fixture
def browser_page(chromium: Any, scenery: Scenery) -> Iterator[Any]:
    page = chromium.new_page(viewport={"width": 1200, "height": 900})
    page.set_default_timeout(_PATIENCE_S * 1000)
    page.goto(scenery.page.url)
    page.add_style_tag(content=".mantine-Notification-root { display: none }")
    yield page
    page.close()


def _blue_pixels(page: Any) -> int:
    png = page.screenshot(clip={"x": 310, "y": 0, "width": 560, "height": 900})
    picture = np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=np.int16)
    return int(((picture[..., 2] > 100) & (picture[..., 0] < 60) & (picture[..., 1] < 60)).sum())


def test_a_robot_appears_once_tf_says_where_it_is(scenery: Scenery, browser_page: Any) -> None:
    browser_page.wait_for_selector("text=bluecar")
    browser_page.wait_for_selector("text=Fixed Frame [odom] does not exist")
    assert _blue_pixels(browser_page) == 0
    broadcaster = TransformBroadcaster(scenery.robot)

    deadline = time.monotonic() + _PATIENCE_S
    while _blue_pixels(browser_page) < 5000:
        assert time.monotonic() < deadline, "the robot never appeared"
        broadcaster.send_transform(
            Transform(parent="odom", child="base_link", stamp_ns=time.time_ns(), translation=(3.0, 0, 0))
        )
        browser_page.wait_for_timeout(100)

    assert browser_page.get_by_text("does not exist").count() == 0


def test_the_pad_publishes_cmd_vel_until_it_is_stopped(scenery: Scenery, browser_page: Any) -> None:
    heard: queue.SimpleQueue[tuple[float, float]] = queue.SimpleQueue()

    def hear(message: Message) -> None:
        heard.put((message.linear.x, message.angular.z))

    for topic in ("/turtle1/cmd_vel", "/later/cmd_vel"):  # the first stays
        scenery.loop.call_soon(lambda topic=topic: scenery.page.drive_on(topic))
    scenery.robot.subscribe("/turtle1/cmd_vel", "geometry_msgs/Twist", hear)
    browser_page.get_by_role("button", name="Forward", exact=True).click()
    assert {heard.get(timeout=_PATIENCE_S) for _ in range(3)} == {(0.5, 0.0)}

    browser_page.get_by_role("button", name="Stop", exact=True).click()
    while heard.get(timeout=_PATIENCE_S) != (0.0, 0.0):
        pass


def test_an_image_topic_of_the_configuration_is_shown(scenery: Scenery, browser_page: Any) -> None:
    camera = scenery.robot.advertise("/camera/image_raw", "sensor_msgs/Image", latch=True)
    data = np.full((24, 32, 3), 200, dtype=np.uint8)

    camera.publish({"height": 24, "width": 32, "encoding": "rgb8", "step": 96, "data": data.ravel()})

    browser_page.get_by_text("/camera/image_raw").wait_for()
    browser_page.wait_for_selector("img[src^='blob:']")


def test_sliders_that_a_node_offers_move_its_joints(scenery: Scenery, browser_page: Any) -> None:
    moved: queue.SimpleQueue[tuple[str, float]] = queue.SimpleQueue()

    scenery.page.offer_sliders([Slider("head_joint", -1.0, 1.0, 0.0)], lambda name, value: moved.put((name, value)))
    browser_page.wait_for_selector("text=head_joint")
    slider = browser_page.get_by_role("slider").last
    slider.focus()
    slider.press("Home")

    assert moved.get(timeout=_PATIENCE_S) == ("head_joint", -1.0)


_PAD = """navigator.getGamepads = () => window.pad ? [window.pad] : [];
window.plug = (axes, buttons) => { window.pad = {
    id: "a pad", connected: true, axes, buttons: buttons.map(value => ({ value })) }; };"""


def test_a_joystick_is_moved_by_hand_and_by_a_pad(scenery: Scenery, browser_page: Any) -> None:
    moved: queue.SimpleQueue[tuple[list[float], list[int]]] = queue.SimpleQueue()
    browser_page.add_init_script(_PAD)
    scenery.loop.call_soon(lambda: scenery.page.offer_joystick(lambda a, b: moved.put((list(a), list(b)))))
    frame = browser_page.frame_locator('iframe[title="joystick"]')
    stick = frame.get_by_label("left stick")
    stick.wait_for()
    box = stick.bounding_box()
    browser_page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    browser_page.mouse.down()
    browser_page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 2)

    _until(moved, lambda axes, _: axes[1] == 1.0)
    browser_page.mouse.up()
    _until(moved, lambda axes, _: axes[1] == 0.0)
    frame.locator("body").evaluate("() => window.plug([0.5, 0, 0, 0], [1])")
    _until(moved, lambda axes, buttons: axes[0] == -0.5 and buttons[0] == 1)


def test_options_of_a_node_are_changed(scenery: Scenery, browser_page: Any) -> None:
    asked: queue.SimpleQueue[Options] = queue.SimpleQueue()

    def apply(values: Options) -> Options:
        asked.put(values)
        return values

    ReconfigureServer(scenery.robot, [Option(name="rate", value=5.0), Option(name="eager", value=False)], apply)
    scenery.loop.call_soon(scenery.page.offer_options)
    browser_page.get_by_text("/robot", exact=True).wait_for()
    browser_page.get_by_label("eager").check()
    assert asked.get(timeout=_PATIENCE_S) == {"rate": 5.0, "eager": True}


def _until(
    moved: "queue.SimpleQueue[tuple[list[float], list[int]]]", reached: Callable[[list[float], list[int]], bool]
) -> None:
    while not reached(*moved.get(timeout=_PATIENCE_S)):
        pass


def test_show_ends_when_the_page_dies(scenery: Scenery) -> None:
    viewer = scenery.page._viewer
    assert viewer is not None
    viewer._process.kill()

    assert scenery.shown.result(timeout=_PATIENCE_S) == 0
    assert scenery.page.url is None


def test_the_graph_and_numbers_over_time_are_drawn_beside(scenery: Scenery, browser_page: Any) -> None:
    """rqt_graph and rqt_plot: their figures are read back from the pictures on the page."""
    points = scenery.robot.advertise("/spot", "geometry_msgs/PointStamped", latch=True)
    points.publish({"point": {"x": 7.0, "y": 8.0}})
    scenery.loop.call_soon(lambda: scenery.page.plot(["/spot/point/x:y"]))
    scenery.loop.call_soon(scenery.page.show_graph)

    graph, plot = (browser_page.wait_for_selector(f"text={title}") for title in ("Graph", "Plot"))
    assert graph.is_visible()
    assert plot.is_visible()
    coded = "data:image/svg+xml;base64,"
    read = f"() => [...document.images].map(i => i.src.split('{coded}')).filter(s => s[1]).map(s => atob(s[1]))"
    deadline = time.monotonic() + _PATIENCE_S
    drawn = ""
    while not all(text in drawn for text in (">/robot<", ">/rviz<", ">/spot<", ">/spot/point/x<", ">/spot/point/y<")):
        assert time.monotonic() < deadline, drawn
        browser_page.wait_for_timeout(100)
        drawn = "".join(browser_page.evaluate(read))


def test_beside_pictures_drawings_are_wide_enough_to_be_read(scenery: Scenery, browser_page: Any) -> None:
    camera = scenery.robot.advertise("/camera/image_raw", "sensor_msgs/Image", latch=True)
    camera.publish({"height": 2, "width": 2, "encoding": "mono8", "step": 2, "data": np.zeros(4, dtype=np.uint8)})
    points = scenery.robot.advertise("/spot", "geometry_msgs/PointStamped", latch=True)
    points.publish({"point": {"x": 7.0}})
    scenery.loop.call_soon(lambda: scenery.page.plot(["/spot/point/x"]))

    browser_page.wait_for_selector("img[src^='blob:']")
    browser_page.wait_for_function(
        "() => [...document.images].some(i => i.src.startsWith('data:image/svg') && i.clientWidth > 500)"
    )


def test_a_configuration_that_comes_later_is_followed(scenery: Scenery, browser_page: Any, tmp_path: Path) -> None:
    browser_page.wait_for_selector("text=Fixed Frame [odom] does not exist")
    later = tmp_path / "later.rviz"
    later.write_text(_CONFIG.replace("odom", "map").replace("/camera/", "/second/"))
    rviz = Node("second_rviz", loop=scenery.loop, master_uri=scenery.robot.master_uri)

    shown = scenery.loop.spawn(scenery.page.show(rviz, config=str(later)))

    browser_page.wait_for_selector("text=Fixed Frame [map] does not exist")
    browser_page.get_by_text("/second/image_raw").wait_for()
    assert not shown.done()
    scenery.loop.run(rviz.shutdown())
    assert shown.result(_PATIENCE_S) == 0
