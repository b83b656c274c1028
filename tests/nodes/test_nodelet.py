"""Nodelets: those we have run, the others are named."""

from tests.nodes.conftest import PATIENCE_S

from trundle.nodes import Replacement
from trundle.nodes.nodelet import NODELETS


def test_every_nodelet_of_the_list_is_there() -> None:
    for target in NODELETS.values():
        assert callable(Replacement(target).load())


def test_a_nodelet_that_a_stand_in_can_be_is_it(stage) -> None:
    stage.start("nodelet/nodelet", "manager", name="manager")
    stage.start("nodelet/nodelet", "load depthimage_to_laserscan/DepthImageToLaserScanNodelet manager", name="scan")
    stage.until(lambda: ["/scan", "sensor_msgs/LaserScan"] in stage.loop.run(stage.client.ask("getTopicTypes")))


def test_another_is_named_and_idles(stage, capsys) -> None:
    running = stage.start("nodelet/nodelet", "standalone image_proc/rectify", name="rectify")
    said = ""

    def named() -> bool:
        nonlocal said
        said += capsys.readouterr().err
        return "nodelet image_proc/rectify: compiled code that nothing stands in for" in said

    stage.until(named)
    assert not running.done()


def test_a_wrong_command_line_is_said(stage, capsys) -> None:
    assert stage.start("nodelet/nodelet", "load", name="wrong").result(PATIENCE_S) == 1
    assert "usage: nodelet" in capsys.readouterr().err
