"""The tutorial's two commands."""

import math
import subprocess
from pathlib import Path

import pytest

from trundle.ros import MasterProxy

TWIST = "{linear: {x: 0.5, y: 0, z: 0}, angular: {x: 0, y: 0, z: 0.5}}"
REAL_ROSTOPIC = "/usr/bin/rostopic"


@pytest.fixture
def packages(shared: Path) -> str:
    return str(shared / "seeds")


@pytest.fixture
def car(start, master, until, packages):
    running = start(
        "launch", "smartcar_description", "smartcar_display.rviz.launch", "--headless", ROS_PACKAGE_PATH=packages
    )
    until("the driver", lambda: "/odom" in dict(master.call("getTopicTypes")))
    return running


def odometry(trundle) -> tuple[float, float]:
    echoed = trundle("topic", "echo", "-n1", "-p", "/odom").stdout.splitlines()
    row = dict(zip(echoed[0].split(","), echoed[1].split(","), strict=True))
    return float(row["field.pose.pose.position.x"]), float(row["field.pose.pose.position.y"])


def test_topic_pub_drives_the_car_until_the_next_command(car, trundle, until) -> None:
    """As in the original, in sim mode the car does not stop after the publisher's end."""
    assert trundle("topic", "pub", "-1", "/cmd_vel", "geometry_msgs/Twist", TWIST).returncode == 0

    first = odometry(trundle)
    until("the car to go on", lambda: math.dist(first, odometry(trundle)) > 0.3)
    assert car.interrupt() == 130
    assert "Traceback" not in car.output()


@pytest.mark.real_ros
@pytest.mark.slow
def test_the_real_rostopic_pub_drives_the_car(car, env, master, until, tmp_path) -> None:
    """Ten seconds after the first command the real arbotix is at −0.938…−0.949, 0.770…0.800, yaw 4.95…4.98."""
    if not Path(REAL_ROSTOPIC).exists():
        pytest.skip("Debian's rostopic is not installed (make system)")
    real = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "ROS_MASTER_URI": env["ROS_MASTER_URI"]}
    commands, odometry_log = tmp_path / "cmd_vel.csv", tmp_path / "odom.csv"
    started: list[subprocess.Popen[bytes]] = []

    def rostopic(*words: str, into: Path | None = None) -> None:
        with (into or tmp_path / "rostopic.log").open("wb") as out:
            started.append(subprocess.Popen([REAL_ROSTOPIC, *words], env=real, stdout=out, stderr=subprocess.DEVNULL))

    def last_ns() -> int:
        rows = _rows(odometry_log)
        return int(rows[-1]["%time"]) if rows else 0

    def first_ns() -> int:
        rows = _rows(commands)
        return int(rows[0]["%time"]) if rows else 2**62

    try:
        rostopic("echo", "-p", "/odom", into=odometry_log)
        rostopic("echo", "-p", "/cmd_vel", into=commands)
        until("the real rostopic to listen", lambda: last_ns() > 0 and _listens(master, "/cmd_vel", 2))
        rostopic("pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", TWIST)
        until("ten seconds of driving", lambda: last_ns() > first_ns() + 10 * 10**9)
    finally:
        for process in started:
            process.kill()
            process.wait()

    row = [r for r in _rows(odometry_log) if int(r["%time"]) <= first_ns() + 10 * 10**9][-1]
    x, y = float(row["field.pose.pose.position.x"]), float(row["field.pose.pose.position.y"])
    yaw = 2 * math.atan2(float(row["field.pose.pose.orientation.z"]), float(row["field.pose.pose.orientation.w"]))
    assert -0.949 - 0.05 <= x <= -0.938 + 0.05
    assert 0.770 - 0.05 <= y <= 0.800 + 0.05
    assert 4.95 - 0.1 <= yaw % math.tau <= 4.98 + 0.1


def _rows(log: Path) -> list[dict[str, str]]:
    """Return the complete lines written by `rostopic echo -p` so far."""
    lines = log.read_text().splitlines() if log.exists() else []
    names = lines[0].split(",") if lines else []
    return [dict(zip(names, line.split(","), strict=True)) for line in lines[1:] if line.count(",") == len(names) - 1]


def _listens(master: MasterProxy, topic: str, count: int) -> bool:
    subscribers = dict(master.call("getSystemState")[1])
    return len(subscribers.get(topic, [])) >= count


def test_parameters_equal_the_original(trundle, shared, packages) -> None:
    import yaml

    done = trundle(
        "launch", "smartcar_description", "smartcar_display.rviz.launch", "--dump-params", ROS_PACKAGE_PATH=packages
    )
    parameters = yaml.safe_load(done.stdout)
    expected = yaml.safe_load((shared / "peers/ros_reference/rosparam_dump.txt").read_text())

    assert parameters["/arbotix/controllers/base_controller/ticks_meter"] == 4100
    for name, value in expected["arbotix"].items():
        if not isinstance(value, dict):
            assert parameters[f"/arbotix/{name}"] == value
    for name, value in expected["arbotix"]["controllers"]["base_controller"].items():
        assert parameters[f"/arbotix/controllers/base_controller/{name}"] == value


def test_a_launch_ends_by_itself_after_its_duration(trundle, packages) -> None:
    done = trundle(
        "launch", "smartcar_description", "smartcar_display.rviz.launch", "--headless", "--duration", "1",
        ROS_PACKAGE_PATH=packages,
    )  # fmt: skip

    assert done.returncode == 0
    assert "Traceback" not in done.stderr
