"""The car of `examples/smartcar`: driven by the arbotix driver, and simulated in a living room."""

import math
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from trundle.ros import open_bag


@pytest.mark.slow
def test_the_car_drives_through_a_living_room_and_scans_the_walls(start, trundle, master, until) -> None:
    start("launch", "smartcar", "drive.launch", "--headless")
    topics = {"/scan", "/odom", "/camera/image_raw", "/joint_states", "/gazebo/model_states"}
    until("the car's topics", lambda: topics <= set(dict(master.call("getTopicTypes"))))
    ranges = trundle("topic", "echo", "-n1", "/scan/ranges").stdout.strip("[]-\n").split(", ")  # until it meets a wall
    start("topic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.3}}")

    def odometry() -> float:
        echoed = trundle("topic", "echo", "-n1", "/odom/pose/pose/position/x")
        return float(echoed.stdout.split()[0])

    until("the car to have moved", lambda: odometry() > 0.2)
    size = trundle("topic", "echo", "-n1", "/camera/image_raw/width").stdout.split()[0]
    tree = trundle("tf", "tree").stdout

    assert min(map(float, ranges)) > 0.15, "the scan does not hit the car"
    assert sum(math.isfinite(float(distance)) for distance in ranges) > 90, (
        "the scan hits two walls, a sofa and a table"
    )
    assert size == "320"
    for frame in ("odom", "base_footprint", "base_link", "left_front_wheel", "head"):
        assert frame in tree


def test_arbotix_in_sim_mode_publishes_odometry(start, trundle, master, until) -> None:
    start("launch", "smartcar", "display.launch", "--headless")
    until("the driver", lambda: "/odom" in dict(master.call("getTopicTypes")))
    start("topic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.5}, angular: {z: 0.5}}")

    def turned() -> float:
        return float(trundle("topic", "echo", "-n1", "/odom/pose/pose/orientation/z").stdout.split()[0])

    until("the car to have turned", lambda: turned() > 0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "topics"),
    [
        ("drive.launch", {"/odom", "/scan", "/tf", "/joint_states", "/camera/image_raw", "/tf_static"}),
        ("display.launch", {"/odom", "/tf", "/joint_states", "/diagnostics"}),
    ],
    ids=["with a simulation", "without"],
)
def test_runs_with_speed_max_write_identical_bags(trundle, tmp_path: Path, file: str, topics: set[str]) -> None:
    """On a busy machine, too, and with any order of Python's sets."""
    for number in (1, 2):
        bag = str(tmp_path / f"{number}.bag")
        words = ("smartcar", file, "--headless", "--speed", "max", "--duration", "3", "--record", bag)
        with ThreadPoolExecutor(1) as pool:
            launching = pool.submit(trundle, "launch", *words, PYTHONHASHSEED=str(number))
            while number == 2 and not launching.done():
                sum(range(100_000))  # one run has the machine to itself, the other shares it
        assert launching.result().returncode == 0, launching.result().stderr

    assert (tmp_path / "1.bag").read_bytes() == (tmp_path / "2.bag").read_bytes()
    with open_bag(tmp_path / "1.bag") as bag:
        counts = {c.topic: count for c, count in zip(bag.connections, bag.counts, strict=True)}
        assert bag.end_ns == 3_000_000_000
    assert counts["/clock"] == 300
    assert topics <= set(counts)
