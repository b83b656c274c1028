"""Default names of built-in nodes started without a launch file or `__name:=`, as in the originals' sources."""

import os
import re
from collections.abc import Sequence

from trundle.robots.names import anonymous_name

_BASE_NAMES: dict[tuple[str, str], str] = {
    ("arbotix_python", "arbotix_driver"): "arbotix",
    ("arbotix_python", "arbotix_driver.py"): "arbotix",
    ("arbotix_python", "arbotix_gui"): "controllerGUI",
    ("arbotix_python", "driver.py"): "arbotix",
    ("gazebo_ros", "debug"): "gazebo",
    ("gazebo_ros", "gdbrun"): "gazebo",
    ("gazebo_ros", "gzserver"): "gazebo",
    ("gazebo_ros", "perf"): "gazebo",
    ("robot_state_publisher", "state_publisher"): "robot_state_publisher",
    ("teleop_twist_joy", "teleop_node"): "teleop_twist_joy_node",
    ("tf2_ros", "buffer_server"): "tf_buffer",
    ("turtlebot3_teleop", "turtlebot3_teleop_key"): "turtlebot3_teleop",
    ("turtlebot_teleop", "turtlebot_teleop_key"): "turtlebot_teleop",
    ("turtlesim", "mimic"): "turtle_mimic",
    ("turtlesim", "turtle_teleop_key"): "teleop_turtle",
    ("turtlesim", "turtlesim_node"): "turtlesim",
}
"""(package, type) → base name, if it differs from the type."""

_ANONYMOUS = frozenset(
    {
        ("controller_manager", "controller_manager"),
        ("controller_manager", "spawner"),
        ("controller_manager", "spawner.py"),
        ("controller_manager", "unspawner"),
        ("dynamic_reconfigure", "dynparam"),
        ("dynamic_reconfigure", "reconfigure_gui"),
        ("gazebo_ros", "spawn_model"),
        ("gazebo_ros", "urdf_spawner"),
        ("image_view", "image_view"),  # the name up to Kinetic
        ("map_server", "map_server"),
        ("rviz", "rviz"),
        ("tf", "static_transform_publisher"),
        ("tf2_ros", "static_transform_publisher"),
        ("topic_tools", "transform"),
    }
)
"""Nodes with anonymous names; command-line tools, such as rostopic, name themselves."""

_TOPIC_ARGUMENTS = {"drop": 0, "mux": 0, "relay": 0, "throttle": 1}
"""Program of topic_tools → index of the argument with the topic in its name."""


def default_name(package: str, executable: str, arguments: Sequence[str]) -> str:
    """Return the default name of a node.

    Args:
        package: package name.
        executable: path or name of the executable.
        arguments: command line without ROS arguments.
    """
    executable = executable.rpartition("/")[2]
    key = (package, executable)
    if package == "nodelet":
        return _nodelet_name(arguments)
    if package.startswith("rqt_"):
        language = "cpp" if package == "rqt_image_view" else "py"
        return f"rqt_gui_{language}_node_{os.getpid()}"
    if package == "topic_tools" and executable in _TOPIC_ARGUMENTS:
        topic = "".join(arguments[_TOPIC_ARGUMENTS[executable] :][:1]).rpartition("/")[2]
        return anonymous_name(f"{_legal(topic)}_{executable}" if topic else executable)
    base = _BASE_NAMES.get(key, _legal(executable.removesuffix(".py")))
    return anonymous_name(base) if key in _ANONYMOUS else base


def _nodelet_name(arguments: Sequence[str]) -> str:
    match list(arguments):
        case ["load" | "standalone", kind, *_]:
            return _legal(kind)
        case ["manager", *_]:
            return "manager"
        case _:
            return "nodelet"


def _legal(text: str) -> str:
    return re.sub(r"\W", "_", text)
