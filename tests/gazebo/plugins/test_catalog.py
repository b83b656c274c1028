"""User plugins found by the file name of the compiled plugin that they replace."""

from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.xmlnode import parse_xml
from trundle.gazebo.plugins import find_plugin
from trundle.robots.model import PluginTag

PLUGIN = "from trundle.gazebo.plugins import Plugin\n\nclass Spin(Plugin):\n    pass\n"


def tag(folder: Path, filename: str = "/home/larry/gazebo_plugin/libspin.so") -> PluginTag:
    return PluginTag(
        name="spin",
        filename=filename,
        at=Source(str(folder / "model.sdf"), 7),
        node=parse_xml("<plugin/>", name="model.sdf"),
    )


def test_a_python_file_beside_the_model_replaces_the_compiled_plugin(tmp_path: Path) -> None:
    (tmp_path / "spin.py").write_text(PLUGIN)

    plugin, origin = find_plugin(tag(tmp_path), {})

    assert plugin.__name__ == "Spin"
    assert origin == str(tmp_path / "spin.py")


def test_the_plugin_paths_are_searched_in_order(tmp_path: Path) -> None:
    for name in ("trundle", "gazebo"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "spin.py").write_text(PLUGIN)
    environment = {
        "GAZEBO_PLUGIN_PATH": str(tmp_path / "gazebo"),
        "TRUNDLE_PLUGIN_PATH": f"{tmp_path / 'missing'}:{tmp_path / 'trundle'}",
    }

    _, origin = find_plugin(tag(tmp_path), environment)

    assert origin == str(tmp_path / "trundle" / "spin.py")


def test_a_missing_plugin_error_lists_the_searched_folders(tmp_path: Path) -> None:
    with pytest.raises(DescriptionError) as error:
        find_plugin(tag(tmp_path), {"GAZEBO_PLUGIN_PATH": "/opt/plugins"})

    message = (
        f"{tmp_path}/model.sdf:7: error: plugin 'spin': no libspin.so; Trundle runs C++ of its kit and Python: "
        f"looked for spin.py in {tmp_path}, /opt/plugins"
    )
    assert str(error.value).startswith(message)


def test_a_missing_plugin_built_by_a_package_names_its_source(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>spinning</name></package>")
    cmake = tmp_path / "CMakeLists.txt"
    cmake.write_text("project(spinning)\nadd_library(spin SHARED src/spin.cc)\nadd_library(other src/other.cc)\n")

    with pytest.raises(DescriptionError) as error:
        find_plugin(tag(tmp_path), {"ROS_MASTER_URI": "http://here:1"})

    source, _, command = str(error.value).partition("; it is C++ that ")[2].partition(" in place of `trundle run`: ")
    assert source == f"{cmake}:2 builds from src/spin.cc; Gazebo itself, with it, in a container"
    assert command.startswith(f"docker run --rm -it --network host -v {tmp_path}:/ws/src/{tmp_path.name}:ro ")
    assert command.endswith("catkin_make && . devel/setup.sh && rosrun gazebo_ros gzserver' [missing-plugin]")
    assert "ROS_MASTER_URI=http://here:1 " in command
    assert " ros-noetic-gazebo-ros " in command


def test_a_sensor_plugin_in_a_model_is_refused_with_its_element(tmp_path: Path) -> None:
    with pytest.raises(DescriptionError) as error:
        find_plugin(tag(tmp_path, "libgazebo_ros_laser.so"), {})

    assert str(error.value) == (
        f"{tmp_path}/model.sdf:7: error: plugin 'spin' (libgazebo_ros_laser.so) is a sensor's; "
        "it belongs into a <sensor> [misplaced-plugin]"
    )


def test_a_user_file_named_like_a_sensor_plugin_runs(tmp_path: Path) -> None:
    (tmp_path / "gazebo_ros_laser.py").write_text(PLUGIN)

    plugin, _ = find_plugin(tag(tmp_path, "libgazebo_ros_laser.so"), {})

    assert plugin.__name__ == "Spin"


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("import trundle\n1 / 0\n", 2, "ZeroDivisionError"),
        ("def (:\n", 1, "SyntaxError"),
        ("x = 1\n", None, "one subclass of Plugin; here: none"),
    ],
)
def test_a_broken_plugin_file_is_reported_with_its_line(
    tmp_path: Path, text: str, line: int | None, words: str
) -> None:
    (tmp_path / "spin.py").write_text(text)

    with pytest.raises(DescriptionError, match=words) as error:
        find_plugin(tag(tmp_path), {})

    assert error.value.at == Source(str(tmp_path / "spin.py"), line)
