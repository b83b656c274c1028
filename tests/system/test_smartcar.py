"""The tutorial's two commands, as it gives them."""

import math
import subprocess
from pathlib import Path

import pytest

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


def test_our_own_topic_pub_drives_the_car_and_it_keeps_on_driving(car, trundle, until) -> None:
    """In sim mode nothing stops it when the publisher is gone, as in the original."""
    assert trundle("topic", "pub", "-1", "/cmd_vel", "geometry_msgs/Twist", TWIST).returncode == 0

    first = odometry(trundle)
    until("the car to go on", lambda: math.dist(first, odometry(trundle)) > 0.3)
    assert car.interrupt() == 130
    assert "Traceback" not in car.output()


@pytest.mark.real_ros
@pytest.mark.slow
def test_the_real_rostopic_pub_drives_the_car(car, env, trundle, until, tmp_path) -> None:
    """Ten seconds after the first command the real arbotix is at −0.938…−0.949, 0.770…0.800 (5 cm either way)."""
    if not Path(REAL_ROSTOPIC).exists():
        pytest.skip("Debian's rostopic is not installed (make system)")
    real = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "ROS_MASTER_URI": env["ROS_MASTER_URI"]}
    log = tmp_path / "odom.csv"
    with log.open("wb") as out:
        echo = subprocess.Popen([REAL_ROSTOPIC, "echo", "-p", "/odom"], env=real, stdout=out)
    until("the real rostopic to listen", lambda: log.stat().st_size > 0)
    publisher = subprocess.Popen([REAL_ROSTOPIC, "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", TWIST], env=real)
    try:
        rows = _rows_until_moving_for(log, 10.5, until)
    finally:
        publisher.kill()
        echo.kill()
        publisher.wait()
        echo.wait()

    start_ns = next(int(r["%time"]) for r in rows if float(r["field.twist.twist.linear.x"]) > 0)
    x, y, yaw = _at(rows, start_ns + 10 * 10**9)
    assert -0.949 - 0.05 <= x <= -0.938 + 0.05
    assert 0.770 - 0.05 <= y <= 0.800 + 0.05
    assert 4.95 - 0.1 <= yaw % math.tau <= 4.98 + 0.1


def _rows(log: Path) -> list[dict[str, str]]:
    header, *lines = log.read_text().splitlines()
    names = header.split(",")
    return [dict(zip(names, line.split(","), strict=True)) for line in lines if line.count(",") == len(names) - 1]


def _rows_until_moving_for(log: Path, seconds: float, until) -> list[dict[str, str]]:
    def long_enough() -> bool:
        moving = [int(r["%time"]) for r in _rows(log) if float(r["field.twist.twist.linear.x"]) > 0]
        return bool(moving) and moving[-1] - moving[0] > seconds * 1e9

    until("ten seconds of driving", long_enough)
    return _rows(log)


def _at(rows: list[dict[str, str]], time_ns: int) -> tuple[float, float, float]:
    """x, y and yaw at an instant, between the two messages around it; the yaw goes on from the first at 0.5 rad/s."""
    after = next(i for i, r in enumerate(rows) if int(r["%time"]) >= time_ns)
    a, b = rows[after - 1], rows[after]
    share = (time_ns - int(a["%time"])) / (int(b["%time"]) - int(a["%time"]))

    def between(name: str) -> float:
        return float(a[name]) + share * (float(b[name]) - float(a[name]))

    z, w = float(a["field.pose.pose.orientation.z"]), float(a["field.pose.pose.orientation.w"])
    turned = 0.5 * share * (int(b["%time"]) - int(a["%time"])) / 1e9
    x, y = between("field.pose.pose.position.x"), between("field.pose.pose.position.y")
    return x, y, 2 * math.atan2(z, w) + turned


def test_parameters_are_those_of_the_original(trundle, shared, packages) -> None:
    import yaml

    done = trundle(
        "launch", "smartcar_description", "smartcar_display.rviz.launch", "--dump-params", ROS_PACKAGE_PATH=packages
    )
    ours = yaml.safe_load(done.stdout)
    theirs = yaml.safe_load((shared / "peers/ros_reference/rosparam_dump.txt").read_text())

    assert ours["/arbotix/controllers/base_controller/ticks_meter"] == 4100
    for name, value in theirs["arbotix"].items():
        if not isinstance(value, dict):
            assert ours[f"/arbotix/{name}"] == value
    for name, value in theirs["arbotix"]["controllers"]["base_controller"].items():
        assert ours[f"/arbotix/controllers/base_controller/{name}"] == value


def test_a_launch_ends_by_itself_after_its_duration(trundle, packages) -> None:
    done = trundle(
        "launch", "smartcar_description", "smartcar_display.rviz.launch", "--headless", "--duration", "1",
        ROS_PACKAGE_PATH=packages,
    )  # fmt: skip

    assert done.returncode == 0
    assert "Traceback" not in done.stderr
