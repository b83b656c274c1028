"""Default names of nodes started from a command line."""

import re

import pytest

from trundle.gazebo.nodes import default_name


@pytest.mark.parametrize(
    ("program", "arguments", "base"),
    [
        ("tf/static_transform_publisher", "0 0 0 0 0 0 a b 100", "static_transform_publisher"),
        ("tf2_ros/static_transform_publisher", "0 0 0 0 0 0 a b", "static_transform_publisher"),
        ("topic_tools/relay", "/base/scan /scan", "scan_relay"),
        ("topic_tools/drop", "scan 1 2", "scan_drop"),
        ("topic_tools/mux", "cmd_vel a b", "cmd_vel_mux"),
        ("topic_tools/throttle", "messages /base/scan 1.0", "scan_throttle"),
        ("topic_tools/relay", "", "relay"),
        ("topic_tools/transform", "/a /b std_msgs/Bool m.data", "transform"),
        ("controller_manager/spawner", "arm", "spawner"),
        ("gazebo_ros/spawn_model", "-model m", "spawn_model"),
        ("map_server/map_server", "map.yaml", "map_server"),
        ("image_view/image_view", "", "image_view"),
        ("rviz/rviz", "-d a.rviz", "rviz"),
    ],
)
def test_anonymous_nodes_have_unique_names(program: str, arguments: str, base: str) -> None:
    package, _, executable = program.partition("/")
    name = default_name(package, executable, arguments.split())
    assert re.fullmatch(rf"{base}_\w+_\d+_\d+", name)


@pytest.mark.parametrize(
    ("program", "arguments", "name"),
    [
        ("turtlesim/turtlesim_node", "", "turtlesim"),
        ("turtlesim/turtle_teleop_key", "", "teleop_turtle"),
        ("turtlesim/mimic", "", "turtle_mimic"),
        ("robot_state_publisher/state_publisher", "", "robot_state_publisher"),
        ("gazebo_ros/gzserver", "empty.world", "gazebo"),
        ("teleop_twist_keyboard/teleop_twist_keyboard.py", "", "teleop_twist_keyboard"),
        ("arbotix_python/driver.py", "", "arbotix"),
        ("nodelet/nodelet", "manager", "manager"),
        ("nodelet/nodelet", "standalone cmd_vel_mux/CmdVelMuxNodelet", "cmd_vel_mux_CmdVelMuxNodelet"),
        ("nodelet/nodelet", "", "nodelet"),
    ],
)
def test_other_nodes_have_fixed_names(program: str, arguments: str, name: str) -> None:
    package, _, executable = program.partition("/")
    assert default_name(package, executable, arguments.split()) == name


def test_windows_of_rqt_are_named_by_their_process() -> None:
    assert re.fullmatch(r"rqt_gui_py_node_\d+", default_name("rqt_graph", "rqt_graph", []))
    assert re.fullmatch(r"rqt_gui_cpp_node_\d+", default_name("rqt_image_view", "rqt_image_view", []))
