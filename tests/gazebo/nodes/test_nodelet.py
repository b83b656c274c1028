"""Nodelets with a stand-in run; others are reported."""

from pathlib import Path

from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.gazebo.nodes import BuiltinReplacement, MissingNode, find_node
from trundle.gazebo.nodes.catalog import NODELETS


def test_every_nodelet_of_the_catalog_exists() -> None:
    for target in NODELETS.values():
        assert callable(BuiltinReplacement(target).load())


def test_a_nodelet_with_a_stand_in_runs(graph) -> None:
    graph.start("nodelet/nodelet", "manager", name="manager")
    graph.start("nodelet/nodelet", "load depthimage_to_laserscan/DepthImageToLaserScanNodelet manager", name="scan")
    graph.until(lambda: ["/scan", "sensor_msgs/LaserScan"] in graph.loop.run(graph.client.master.call("getTopicTypes")))


def test_an_unsupported_nodelet_is_reported_before_anything_starts(graph, capsys) -> None:
    arguments = "standalone image_proc/rectify"
    assert graph.start("nodelet/nodelet", arguments, name="rectify").result(PATIENCE_S) == 1
    message = "nodelet image_proc/rectify: compiled code without a stand-in"
    assert message in capsys.readouterr().err
    node = find_node("nodelet", "nodelet", lambda _: None, env={}, arguments=arguments)
    assert isinstance(node, MissingNode)
    assert node.reason.startswith(message)
    assert node.reason.endswith(
        "apt-get install -y ros-noetic-image-proc && rosrun nodelet nodelet standalone image_proc/rectify'"
    )
    for arguments in ("manager", "load pointcloud_to_laserscan/pointcloud_to_laserscan_nodelet m", "unload x m"):
        assert isinstance(
            find_node("nodelet", "nodelet", lambda _: None, env={}, arguments=arguments), BuiltinReplacement
        )


def test_a_nodelet_of_a_local_package_is_compiled_in_the_container(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text("project(near)")
    node = find_node("nodelet", "nodelet", lambda _: tmp_path, env={}, arguments="load near/Blur manager")
    assert isinstance(node, MissingNode)
    assert f"-v {tmp_path}:/ws/src/{tmp_path.name}:ro " in node.reason
    assert node.reason.endswith("catkin_make && . devel/setup.sh && rosrun nodelet nodelet standalone near/Blur'")


def test_an_invalid_command_line_is_reported(graph, capsys) -> None:
    assert graph.start("nodelet/nodelet", "load", name="wrong").result(PATIENCE_S) == 1
    assert "usage: nodelet" in capsys.readouterr().err
