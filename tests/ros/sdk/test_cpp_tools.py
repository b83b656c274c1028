"""Libraries that many nodes use, in a compiled program: diagnostics, images, clouds, controllers."""

import re
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running

from trundle.ros import Messages

pytestmark = pytest.mark.slow


def test_the_libraries_work_and_their_messages_arrive(
    running: Running, graph: Graph, messages: Messages, tmp_path: Path
) -> None:
    running.environment["ROS_HOME"] = str(tmp_path)
    node = graph.node("tester")
    statuses: dict[str, Any] = {}
    numbers: list[float] = []
    images: list[Any] = []
    infos: list[Any] = []
    node.subscribe(
        "/diagnostics", "diagnostic_msgs/DiagnosticArray",
        lambda message: statuses.update({status.name: status for status in message.status}),
    )  # fmt: skip
    node.subscribe("/numbers", "std_msgs/Float64", lambda message: numbers.append(message.data))
    node.subscribe("/small/image", "sensor_msgs/Image", images.append)
    node.subscribe("/small/camera_info", "sensor_msgs/CameraInfo", infos.append)
    image = node.advertise("/eye/image_raw", "sensor_msgs/Image")
    info = node.advertise("/eye/camera_info", "sensor_msgs/CameraInfo")
    process = running.start("tools", package="cpp_tools")
    assert process.stdout is not None
    lines = iter(process.stdout.readline, "")
    last = next(line for line in lines if "checks" in line or process.poll() is not None)
    assert re.fullmatch(r"\d\d checks, 0 failed\n", last), last

    until(lambda: image.subscribers and info.subscribers and len(numbers) > 3)
    assert numbers == [numbers[0] + i for i in range(len(numbers))]
    header = {"stamp": {"sec": 5, "nanosec": 0}, "frame_id": "eye"}
    pixels = {"height": 2, "width": 2, "step": 6, "encoding": "rgb8", "data": bytes(range(12))}

    def is_passed_on() -> bool:
        image.publish(messages.new("sensor_msgs/Image", {"header": header, **pixels}))
        info.publish(messages.new("sensor_msgs/CameraInfo", {"header": header, "width": 2, "height": 2}))
        return bool(images and infos)

    until(is_passed_on)
    assert (images[0].height, images[0].width, images[0].encoding) == (1, 2, "rgb8")
    assert bytes(images[0].data) == bytes(range(6))
    assert infos[0].header.frame_id == "eye"

    until(
        lambda: statuses.get("tools: battery") is not None and statuses["tools: battery"].message != "Node starting up"
    )
    battery = statuses["tools: battery"]
    assert (battery.level, battery.message, battery.hardware_id) == (1, "hot: 60 °C", "robot 7")
    assert {pair.key: pair.value for pair in battery.values} == {
        "volts": "12.5",
        "charging": "True",
        "cells": "3 of 4",
    }
    until(lambda: statuses["tools: ticks topic status"].message == "No events recorded.")


@pytest.mark.parametrize(("program", "library"), [("matrices", "Eigen"), ("pictures", "OpenCV"), ("chains", "KDL")])
def test_conversions_to_a_library_of_the_machine(running: Running, program: str, library: str) -> None:
    if not (running.folder / "cpp_tools" / program).exists():
        pytest.skip(f"this machine has no {library} for C++")
    process = running.start(program, package="cpp_tools")
    output, _ = process.communicate(timeout=WAIT_S)

    assert re.search(r"^\d+ checks, 0 failed$", output, re.MULTILINE), output
    assert process.returncode == 0
