"""Commands of both tutorials, typed into `trundle shell` as printed.

Omitted are commands that install software or open an editor, which need root, the net or a person:

    sudo apt-get install gazebo5, ros-indigo-…          (Trundle takes their place)
    wget … | sudo apt-key add -
    gedit model.config, model.sdf, *.xacro              (the files are the published ones)
"""

import re
import sys
import urllib.request
from pathlib import Path

import pytest
from tests.ros.shell.terminal import Terminal

pytestmark = pytest.mark.slow
PATIENCE_S = 240.0
"""Maximum start time of a launch or a world on a busy machine [s]."""
TWIST = "'{linear: {x: 0.5, y: 0, z: 0}, angular: {x: 0, y: 0, z: 0.5}}'"


@pytest.fixture
def terminal(env: dict[str, str], tmp_path: Path):
    """Return a function that opens a terminal with `trundle shell`; all are closed at the end."""
    opened: list[Terminal] = []
    env |= {"TERM": "dumb", "PYTHONUNBUFFERED": "1"}
    (tmp_path / ".bashrc").write_text("PS1='$ '\n")

    def call() -> Terminal:
        opened.append(Terminal([sys.executable, "-m", "trundle", "shell"], env, tmp_path))
        opened[-1].expect("(trundle) $ ")
        return opened[-1]

    yield call
    for shell in opened:
        shell.close()


def finish(terminal: Terminal, line: str, patience_s: float = PATIENCE_S) -> str:
    """Type a command, and return what it prints until the prompt is back."""
    terminal.type(line)
    terminal.expect(line)
    return terminal.expect("(trundle) $ ", patience_s).removesuffix("(trundle) $ ")


def page_at(printed: str, terminal: Terminal) -> str:
    """Return the page at the URL that is printed after a text."""
    terminal.expect(printed, PATIENCE_S)
    url = re.search(r"http://[\w.:/?=&-]+", terminal.expect("\n"))
    assert url is not None
    with urllib.request.urlopen(url[0], timeout=PATIENCE_S) as answer:
        return answer.read().decode()


def test_the_car_with_roslaunch(terminal, shared: Path) -> None:
    car = terminal()
    finish(car, "mkdir -p ~/catkin_ws/src && cd ~/catkin_ws/src")
    assert "Creating " in finish(car, "catkin_init_workspace")
    finish(car, f"cp -r {shared}/seeds/smartcar_description . && chmod -R u+w smartcar_description")
    finish(car, "cd ~/catkin_ws")
    assert "Devel space: " in finish(car, "catkin_make")
    finish(car, "source devel/setup.bash")
    assert "smartcar_display.rviz.launch" in finish(car, "rosls smartcar_description/launch")
    car.type("roslaunch smartcar_description smartcar_display.rviz.launch")
    assert "<html" in page_at("see it at ", car)

    driver = terminal()
    driver.type(f"rostopic pub -r 10 /cmd_vel geometry_msgs/Twist {TWIST}")
    watcher = terminal()
    assert "/cmd_vel" in finish(watcher, "rostopic list")
    assert "/arbotix" in finish(watcher, "rosnode list")
    watcher.type("rostopic echo /odom/twist/twist/linear/x")
    watcher.expect("\n0.5", PATIENCE_S)
    watcher.keys("\x03")
    watcher.expect("(trundle) $ ", PATIENCE_S)
    watcher.type("rosrun tf tf_echo odom base_link")
    watcher.expect("- Translation: [", PATIENCE_S)
    watcher.keys("\x03")
    watcher.expect("(trundle) $ ", PATIENCE_S)
    watcher.type("rviz -f odom")
    assert "<html" in page_at("see it at ", watcher)

    for shell in (watcher, driver, car):
        shell.keys("\x03")
        shell.expect("(trundle) $ ", PATIENCE_S)
        shell.type("exit")
        assert shell.wait() in (0, 130)
        assert "Traceback" not in shell.printed


def test_the_telepresence_robot_in_gazebo(terminal, shared: Path, tmp_path: Path) -> None:
    gazebo = terminal()
    gazebo.type("gazebo")
    assert "<html" in page_at("see it at ", gazebo)
    gazebo.keys("\x03")
    gazebo.expect("(trundle) $ ", PATIENCE_S)
    finish(gazebo, "mkdir -p ~/.gazebo/models/rp2w && cd ~/.gazebo/models/rp2w")
    finish(gazebo, f"cp {shared}/seeds/rp2w/model.* .")
    assert "Check complete" in finish(gazebo, "gz sdf -k model.sdf")
    gazebo.type("gazebo")
    gazebo.expect("see it at ", PATIENCE_S)

    robot = terminal()
    finish(robot, "gz model -m rp2w -f ~/.gazebo/models/rp2w/model.sdf")
    assert re.match(r"\s*-?[\d.e-]+( -?[\d.e-]+){5}\s", finish(robot, "gz model -m rp2w -p"))
    topics = finish(robot, "rostopic list")
    assert "/rp2w/camera/my_sensor/image_raw" in topics
    assert "/rp2w/body/netbook_webcam/image_raw" in topics
    robot.type("rostopic echo -n 1 /rp2w/camera/my_sensor/image_raw/width")
    robot.expect("\n320", PATIENCE_S)
    robot.expect("(trundle) $ ", PATIENCE_S)

    gazebo.keys("\x03")
    gazebo.expect("(trundle) $ ", PATIENCE_S)
    for shell in (robot, gazebo):
        shell.type("exit")
        assert shell.wait() in (0, 130)
        assert "Traceback" not in shell.printed
    assert (tmp_path / ".gazebo/models/rp2w/model.sdf").is_file()
