"""Turtles move, draw, stop at walls and handle services as the original's do."""

import math

import pytest
from tests.gazebo.nodes.fakes import FakeDisplay

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.turtlesim.turtle import Turtle
from trundle.gazebo.nodes.turtlesim.turtle_frame import SIZE_M, SIZE_PX, TurtleFrame


def test_the_plane_has_the_size_of_the_original() -> None:
    """499 of 500 pixels at 45 pixels a metre; turtle1 starts at 5.544445."""
    assert pytest.approx(5.544445, abs=1e-6) == SIZE_M / 2.0


def test_a_command_holds_for_a_second() -> None:
    turtle = Turtle(1.0, 1.0, math.pi / 2.0, size=SIZE_M)
    turtle.command(1.0, 0.0, 0.0, now_ns=0)
    for pass_ in range(200):
        turtle.update(0.016, now_ns=pass_ * 16_000_000)

    assert turtle.y == pytest.approx(1.0 + 63 * 0.016)  # passes 0 … 62 lie within the second
    assert turtle.x == pytest.approx(1.0)
    assert turtle.linear_velocity == 0.0


def test_a_circle_closes() -> None:
    turtle = Turtle(5.0, 5.0, 0.0, size=SIZE_M)
    steps = 1000
    turtle.command(1.0, 0.0, math.tau, now_ns=0)
    for _ in range(steps):
        turtle.update(1.0 / steps, now_ns=0)
    assert (turtle.x, turtle.y) == (pytest.approx(5.0, abs=1e-9), pytest.approx(5.0, abs=1e-9))


def test_a_turtle_moves_sideways_and_publishes_its_speed() -> None:
    turtle = Turtle(5.0, 5.0, 0.0, size=SIZE_M)
    turtle.command(-3.0, 4.0, 0.0, now_ns=0)
    turtle.update(0.1, now_ns=0)
    assert (turtle.x, turtle.y, turtle.linear_velocity) == (pytest.approx(4.7), pytest.approx(5.4), 5.0)


def test_a_later_command_does_not_change_the_motion_before_it() -> None:
    turtle = Turtle(1.0, 1.0, 0.0, size=SIZE_M)
    turtle.command(1.0, 0.0, 0.0, now_ns=0)
    turtle.command(2.0, 0.0, 0.0, now_ns=400_000_000)
    for tick in range(10):
        turtle.update(0.1, now_ns=tick * 100_000_000)
    assert turtle.x == pytest.approx(1.0 + 4 * 0.1 + 6 * 0.2)


def test_walls_stop_a_turtle() -> None:
    turtle = Turtle(SIZE_M - 0.1, 1.0, 0.0, size=SIZE_M)
    turtle.command(5.0, 0.0, 0.0, now_ns=0)
    turtle.update(0.1, now_ns=0)
    assert (turtle.x, turtle.hit_wall) == (SIZE_M, True)


def test_a_path_is_drawn_where_the_turtle_went() -> None:
    picture = TurtleFrame((0, 0, 0))
    picture.draw_line((1.0, 1.0), (2.0, 1.0), (255, 0, 0), 3)
    assert picture.color_at(1.5, 1.0) == (255, 0, 0)
    assert picture.color_at(1.5, 1.5) == (0, 0, 0)
    assert len(picture.with_turtles([Turtle(1.0, 1.0, 0.0, size=SIZE_M)])) == 3 * SIZE_PX**2


def test_the_tutorials_services(graph) -> None:
    graph.start("turtlesim/turtlesim_node", name="sim")
    poses = graph.listen("/bob/pose", "turtlesim/Pose")
    images = graph.listen("/sim/image", "sensor_msgs/Image")
    assert graph.call("/spawn", "turtlesim/Spawn", x=2.0, y=3.0, theta=0.5, name="bob").name == "bob"
    assert graph.call("/spawn", "turtlesim/Spawn", x=1.0, y=1.0).name == "turtle2"
    graph.call("/bob/set_pen", "turtlesim/SetPen", r=255, width=5)
    graph.call("/bob/teleport_relative", "turtlesim/TeleportRelative", linear=1.0, angular=-0.5)
    graph.until(lambda: poses and poses[-1].x == pytest.approx(3.0))
    graph.until(lambda: images)

    assert poses[-1].theta == pytest.approx(0.0, abs=1e-6)
    assert (images[-1].width, images[-1].encoding) == (500, "rgb8")
    graph.call("/kill", "turtlesim/Kill", name="bob")
    graph.call("/kill", "turtlesim/Kill", name="turtle2")
    assert graph.call("/spawn", "turtlesim/Spawn", x=1.0, y=1.0).name == "turtle3"  # no number comes twice
    graph.call("/reset", "std_srvs/Empty")
    assert graph.call("/spawn", "turtlesim/Spawn", x=1.0, y=1.0).name == "turtle2"
    assert graph.loop.run(graph.client.params.get("/sim/background_b")) == 255


def test_a_turtle_follows_commands_and_another_mimics_it(graph) -> None:
    graph.start("turtlesim/turtlesim_node")
    graph.call("/spawn", "turtlesim/Spawn", x=2.0, y=2.0, name="ape")
    graph.start("turtlesim/mimic", "input/pose:=turtle1/pose output/cmd_vel:=ape/cmd_vel")
    poses = graph.listen("/ape/pose", "turtlesim/Pose")
    graph.until(lambda: poses)
    commands = graph.advertise("/turtle1/cmd_vel", "geometry_msgs/Twist")

    def moved() -> bool:
        commands.publish({"linear": {"x": 1.0}})  # a turtle obeys a command for a second
        return poses[-1].x > 2.2

    graph.until(moved)
    assert poses[-1].y == pytest.approx(2.0)


def test_a_turtle_moves_by_elapsed_time_when_updates_are_late(graph) -> None:
    """As on a busy machine; here simulated time passes in large steps."""
    graph.set_params({"/use_sim_time": True})
    graph.start("turtlesim/turtlesim_node")
    clock = graph.advertise("/clock", "rosgraph_msgs/Clock")
    commands = graph.advertise("/turtle1/cmd_vel", "geometry_msgs/Twist")
    poses = graph.listen("/turtle1/pose", "turtlesim/Pose")
    graph.until(lambda: graph.connected("/turtle1/pose"))
    for seconds, x in ((10.0, 0.0), (10.5, 0.5), (11.5, 1.0), (13.0, 1.0), (2.0, 1.0), (3.0, 1.0)):
        before = len(poses)
        clock.publish({"clock": round(seconds * 1e9)})
        graph.until(lambda before=before: len(poses) > before)
        assert poses[-1].x == pytest.approx(SIZE_M / 2.0 + x, abs=0.033)
        if seconds == 10.0:
            commands.publish({"linear": {"x": 1.0}})  # holds for a second


def test_draw_square_drives_forward(graph) -> None:
    graph.start("turtlesim/turtlesim_node")
    graph.start("turtlesim/draw_square")
    poses = graph.listen("/turtle1/pose", "turtlesim/Pose")
    graph.until(lambda: poses and poses[-1].x > 5.8)
    assert poses[-1].y == pytest.approx(5.544445, abs=1e-3)


def test_without_a_terminal_the_key_readers_report_it(graph, capsys) -> None:
    graph.start("turtlesim/turtle_teleop_key")
    graph.start("teleop_twist_keyboard/teleop_twist_keyboard.py")
    graph.until(
        lambda: (
            {"/turtle1/cmd_vel", "/cmd_vel"}
            <= {t for t, _ in graph.loop.run(graph.client.master.call("getTopicTypes"))}
        )
    )
    log_text = ""

    def both_report_it() -> bool:
        nonlocal log_text
        log_text += capsys.readouterr().err
        return log_text.count("no terminal to read keys from") == 2

    graph.until(both_report_it)


@pytest.mark.parametrize(
    ("params", "topic"), [({}, "/cmd_vel"), ({"default_topic": "turtle1/cmd_vel"}, "/turtle1/cmd_vel")]
)
def test_rqt_robot_steering_uses_the_page(graph, params: dict[str, str], topic: str) -> None:
    page = FakeDisplay()
    graph.start("rqt_robot_steering/rqt_robot_steering", host=NodeHost(display=page), **params)
    graph.until(lambda: page.shown)
    assert page.driven == [topic]


def test_the_page_shows_the_image_and_drives_the_turtle(graph) -> None:
    page = FakeDisplay()
    graph.start("turtlesim/turtlesim_node", host=NodeHost(display=page))
    graph.until(lambda: page.shown)
    assert (page.images, page.driven) == (["/turtlesim_node/image"], ["/turtle1/cmd_vel"])
