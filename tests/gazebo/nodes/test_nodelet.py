"""Nodelets with a stand-in run; others are reported."""

from pathlib import Path

from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.gazebo.nodes import BuiltinReplacement, Executable, MissingNode, find_node
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
    assert "; catkin_make compiles near, after which launch files load it" in node.reason
    assert f"-v {tmp_path}:/ws/src/{tmp_path.name}:ro " in node.reason
    assert node.reason.endswith("catkin_make && . devel/setup.sh && rosrun nodelet nodelet standalone near/Blur'")


def test_a_compiled_nodelet_and_its_manager_run_in_the_kits_program(tmp_path: Path) -> None:
    """catkin_make links it into the workspace; nodelets with a stand-in do without."""
    folder = tmp_path / "ws/src/near"
    folder.mkdir(parents=True)
    (tmp_path / "nodelet").touch(mode=0o755)
    home = tmp_path / "ws/devel/lib/nodelet"
    home.mkdir(parents=True)
    (home / "nodelet").symlink_to(tmp_path / "nodelet")
    env = {"ROS_PACKAGE_PATH": f"{tmp_path}/none:{tmp_path}/ws/src"}

    def find(arguments: str) -> object:
        return find_node(
            "nodelet", "nodelet", lambda name: folder if name == "near" else None, env=env, arguments=arguments
        )

    for arguments in ("load near/Blur m", "standalone near/Blur", "manager", "unload near m"):
        assert find(arguments) == Executable(home / "nodelet")
    stand_in = "load depthimage_to_laserscan/DepthImageToLaserScanNodelet manager"
    assert isinstance(find(stand_in), BuiltinReplacement)
    assert isinstance(find("load image_proc/rectify manager"), MissingNode)


def test_an_invalid_command_line_is_reported(graph, capsys) -> None:
    assert graph.start("nodelet/nodelet", "load", name="wrong").result(PATIENCE_S) == 1
    assert "usage: nodelet" in capsys.readouterr().err
