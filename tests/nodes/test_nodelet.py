"""Nodelets: those we have run, the others are named."""

from tests.nodes.conftest import PATIENCE_S

from trundle.nodes import BuiltinReplacement, MissingNode, find_node
from trundle.nodes.catalog import NODELETS


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
    for there in ("manager", "load pointcloud_to_laserscan/pointcloud_to_laserscan_nodelet m", "unload x m"):
        assert isinstance(find_node("nodelet", "nodelet", lambda _: None, env={}, arguments=there), BuiltinReplacement)


def test_a_wrong_command_line_is_said(stage, capsys) -> None:
    assert stage.start("nodelet/nodelet", "load", name="wrong").result(PATIENCE_S) == 1
    assert "usage: nodelet" in capsys.readouterr().err
