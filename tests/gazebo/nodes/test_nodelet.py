"""Nodelets: those we have run, the others are named."""

from pathlib import Path

from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.gazebo.nodes import BuiltinReplacement, MissingNode, find_node
from trundle.gazebo.nodes.catalog import NODELETS


def test_every_nodelet_of_the_list_is_there() -> None:
    for target in NODELETS.values():
        assert callable(BuiltinReplacement(target).load())


def test_a_nodelet_that_a_stand_in_can_be_is_it(stage) -> None:
    stage.start("nodelet/nodelet", "manager", name="manager")
    stage.start("nodelet/nodelet", "load depthimage_to_laserscan/DepthImageToLaserScanNodelet manager", name="scan")
    stage.until(lambda: ["/scan", "sensor_msgs/LaserScan"] in stage.loop.run(stage.client.master.call("getTopicTypes")))


def test_another_is_named_before_anything_starts(stage, capsys) -> None:
    words = "standalone image_proc/rectify"
    assert stage.start("nodelet/nodelet", words, name="rectify").result(PATIENCE_S) == 1
    why = "nodelet image_proc/rectify: compiled code without a stand-in"
    assert why in capsys.readouterr().err
    found = find_node("nodelet", "nodelet", lambda _: None, env={}, arguments=words)
    assert isinstance(found, MissingNode)
    assert found.why.startswith(why)
    assert found.why.endswith(
        "apt-get install -y ros-noetic-image-proc && rosrun nodelet nodelet standalone image_proc/rectify'"
    )
    for there in ("manager", "load pointcloud_to_laserscan/pointcloud_to_laserscan_nodelet m", "unload x m"):
        assert isinstance(find_node("nodelet", "nodelet", lambda _: None, env={}, arguments=there), BuiltinReplacement)


def test_one_of_a_package_here_is_compiled_in_the_container(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text("project(near)")
    found = find_node("nodelet", "nodelet", lambda _: tmp_path, env={}, arguments="load near/Blur manager")
    assert isinstance(found, MissingNode)
    assert f"-v {tmp_path}:/ws/src/{tmp_path.name}:ro " in found.why
    assert found.why.endswith("catkin_make && . devel/setup.sh && rosrun nodelet nodelet standalone near/Blur'")


def test_a_wrong_command_line_is_said(stage, capsys) -> None:
    assert stage.start("nodelet/nodelet", "load", name="wrong").result(PATIENCE_S) == 1
    assert "usage: nodelet" in capsys.readouterr().err
