"""Messages in sub-folders, and in the folders that add_message_files(DIRECTORY …) names."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.ros.messages.definition_files import definition_files
from trundle.ros.rospy.environment import with_finder

CMAKE = """project(arm_msgs)
find_package(catkin REQUIRED COMPONENTS message_generation)
add_message_files(DIRECTORY messages/common FILES Grip.msg)
add_service_files(DIRECTORY ${PROJECT_SOURCE_DIR}/services)
add_message_files(DIRECTORY ../../outside)
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "src/arm_msgs"
    files = {
        "package.xml": "<package><name>arm_msgs</name></package>",
        "CMakeLists.txt": CMAKE,
        "msg/State.msg": "Finger[] fingers\n",
        "msg/hand/Finger.msg": "float64 angle\n",
        "msg/hand/State.msg": "int8 other\n",
        "messages/common/Grip.msg": "Finger finger\n",
        "services/Open.srv": "---\nGrip grip\n",
        "../../outside/Secret.msg": "int8 x\n",
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def test_each_type_has_one_file_inside_the_package(package: Path) -> None:
    paths = [str(path.relative_to(package)) for path in definition_files(package, "msg")]
    assert paths == ["msg/hand/Finger.msg", "messages/common/Grip.msg", "msg/State.msg"]


def test_srv_show_reads_messages_in_sub_folders(
    package: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(package.parent))

    assert main(["srv", "show", "arm_msgs/Open"]) == 0

    assert capsys.readouterr().out == "---\narm_msgs/Grip grip\n  arm_msgs/Finger finger\n    float64 angle\n\n"


def test_programs_import_messages_in_sub_folders(package: Path) -> None:
    code = "from arm_msgs.msg import Grip, State; from arm_msgs.srv import Open; print(State([Grip().finger]))"
    env = {name: value for name, value in os.environ.items() if not name.startswith("ROS")} | with_finder({})
    env["ROS_PACKAGE_PATH"] = str(package.parent)
    done = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("fingers: \n  - \n    angle: 0.0\n", "")
