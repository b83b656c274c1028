"""message_filters and the message filters of tf, in compiled programs."""

import re
from typing import Any

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running

from trundle.ros import Messages

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("program", ["sets", "chains"])
def test_a_programs_own_checks_pass(running: Running, program: str) -> None:
    """Sets of messages, and chains of filters of values."""
    process = running.start(program, package="cpp_filters")
    output, _ = process.communicate(timeout=WAIT_S)

    assert re.search(r"^\d\d checks, 0 failed$", output, re.MULTILINE), output
    assert process.returncode == 0


def test_scans_wait_for_odometry_and_for_frames(running: Running, graph: Graph, messages: Messages) -> None:
    """Scans of a Python node: each is paired with the nearest odometry, and passed on once tf reaches its stamp."""
    node = graph.node("tester")
    said: list[str] = []
    node.subscribe("/said", "std_msgs/String", lambda message: said.append(message.data))
    scans = node.advertise("/scan", "sensor_msgs/LaserScan")
    odometry = node.advertise("/odom", "nav_msgs/Odometry")
    frames = node.advertise("/tf", "tf2_msgs/TFMessage")
    running.start("scans", package="cpp_filters")
    until(lambda: scans.subscribers and odometry.subscribers and frames.subscribers)

    def header(stamp: float, frame: str) -> dict[str, Any]:
        return {"stamp": {"sec": int(stamp), "nanosec": round(stamp % 1 * 1e9)}, "frame_id": frame}

    def send_frame(stamp: float) -> None:
        transform = {"translation": {"x": stamp}, "rotation": {"w": 1.0}}
        tree = [{"header": header(stamp, "odom"), "child_frame_id": "laser", "transform": transform}]
        frames.publish(messages.new("tf2_msgs/TFMessage", {"transforms": tree}))

    for stamp in (100.0, 101.0, 102.0):
        scans.publish(messages.new("sensor_msgs/LaserScan", {"header": header(stamp, "/laser")}))
        odometry.publish(messages.new("nav_msgs/Odometry", {"header": header(stamp + 0.25, "odom")}))
    until(lambda: len(said) >= 2)
    assert said == ["pair 100 100.25", "pair 101 101.25"], "no frame is known yet"
    for stamp in (99.0, 101.5):
        send_frame(stamp)
    until(lambda: len(said) >= 6)
    assert sorted(said[2:]) == ["tf 100", "tf 101", "tf2 100", "tf2 101"]

    for stamp in (102.5, 130.0, 131.0, 132.0):  # what is older than ten seconds is forgotten then
        send_frame(stamp)
    until(lambda: {"tf 102", "tf2 102"} <= set(said))
    scans.publish(messages.new("sensor_msgs/LaserScan", {"header": header(103.0, "laser")}))
    scans.publish(messages.new("sensor_msgs/LaserScan", {"header": header(131.5, "")}))
    until(lambda: {"too old 103", "without frame 131.5"} <= set(said))
    assert "tf2 103" not in said
