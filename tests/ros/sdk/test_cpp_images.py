"""Transports of images in compiled programs, and what else robots' packages bring."""

import io
import re
import subprocess
from typing import Any
from xmlrpc.client import ServerProxy

import pytest
from PIL import Image
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running

from trundle.ros import MasterProxy, Messages

pytestmark = pytest.mark.slow


def _checks(running: Running, process: "subprocess.Popen[str] | None" = None) -> str:
    """Start the program; return its verdict."""
    process = process or running.start("shots", package="cpp_images")
    assert process.stdout is not None
    lines = iter(process.stdout.readline, "")
    last = next((line for line in lines if " checks, " in line), "ended")
    assert re.match(r"\d+ checks, 0 failed", last), last
    return last


def test_images_arrive_by_all_transports(running: Running, graph: Graph) -> None:
    node = graph.node("tester")
    pictures: list[Any] = []
    if "nothing compressed" in _checks(running):
        pytest.skip("this machine has no libjpeg and libpng for C++")
    node.subscribe("/shot/compressed", "sensor_msgs/CompressedImage", pictures.append)
    until(lambda: bool(pictures))

    assert pictures[0].format == "rgb8; jpeg compressed bgr8"
    picture = Image.open(io.BytesIO(bytes(pictures[0].data)))
    assert (picture.size, picture.mode) == ((32, 24), "RGB")
    assert picture.getpixel((8, 4)) == pytest.approx((80, 120, 160), abs=12)


def test_a_program_answers_shutdown_by_itself(running: Running, graph: Graph) -> None:
    process = running.start("shots", package="cpp_images")
    _checks(running, process)
    uri = MasterProxy(graph.core.uri).call("lookupNode", "/shots")

    with ServerProxy(uri) as slave:
        assert slave.shutdown("/tester", "enough") == [1, "", 0]
    output, _ = process.communicate(timeout=WAIT_S)
    assert "asked to end: enough\n" in output
    assert "Shutdown request received" not in output
    assert process.returncode == 0


def test_a_program_publishes_compressed_images_as_raw(running: Running, graph: Graph, messages: Messages) -> None:
    node = graph.node("tester")
    arrived: list[Any] = []
    process = running.start("republish", "compressed", "in:=/eye", "raw", "out:=/seen", package="image_transport")
    node.subscribe("/seen", "sensor_msgs/Image", arrived.append)
    publisher = node.advertise("/eye/compressed", "sensor_msgs/CompressedImage")
    file = io.BytesIO()
    Image.new("RGB", (4, 2), (200, 100, 50)).save(file, "PNG")

    def is_passed_on() -> bool:
        publisher.publish(messages.new("sensor_msgs/CompressedImage", {"format": "png", "data": file.getvalue()}))
        return bool(arrived) or process.poll() is not None

    until(is_passed_on)
    if not arrived:
        output, _ = process.communicate(timeout=WAIT_S)
        assert "libjpeg-dev" in output
        pytest.skip("this machine has no libjpeg and libpng for C++")
    assert (arrived[0].width, arrived[0].height, arrived[0].encoding) == (4, 2, "bgr8")
    assert bytes(arrived[0].data) == bytes((50, 100, 200)) * 8
    assert "/seen/compressed" not in dict(MasterProxy(graph.core.uri).call("getTopicTypes"))
