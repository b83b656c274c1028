"""`trundle tf`, with the output of tf's tools."""

import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tests.app.cli.conftest import PATIENCE_S

from trundle.base.xmlnode import parse_xml
from trundle.ros import StaticTransformBroadcaster, Transform, TransformBroadcaster, WallClock


@pytest.fixture
def robot(graph: Any) -> Any:
    """odom → base → laser, the first moving, the second static."""
    node = graph.node("robot")
    broadcaster = TransformBroadcaster(node)

    async def drive() -> None:
        while True:
            broadcaster.send_transform(
                Transform(
                    parent="odom",
                    child="base",
                    stamp_ns=node.clock.now_ns(),
                    translation=(1.0, 2.0, 0.0),
                    rotation=(0.5**0.5, 0.0, 0.0, 0.5**0.5),
                )
            )
            await WallClock().sleep(0.01)

    StaticTransformBroadcaster(node).send_transform(
        Transform(parent="base", child="laser", translation=(0.5, 0.0, 0.25))
    )
    graph.ready(node)
    driving = graph.loop.spawn(drive())
    yield node
    driving.cancel()


def test_a_transform_is_printed_as_by_tf_echo(graph: Any, robot: Any) -> None:
    code, out, error = graph.trundle("tf", "echo", "-n", "1", "odom", "/laser")
    assert (code, error) == (0, "")
    stamp, _, rest = out.partition("\n")
    assert stamp.startswith("At time ")
    assert rest == (
        "- Translation: [1.000, 2.500, 0.250]\n"
        "- Rotation: in Quaternion [0.000, 0.000, 0.707, 0.707]\n"
        "            in RPY (radian) [0.000, -0.000, 1.571]\n"
        "            in RPY (degree) [0.000, -0.000, 90.000]\n"
    )
    code, out, _ = graph.trundle("tf", "echo", "-n", "1", "odom", "camera")
    assert code == 1
    assert out.startswith("Failure at ")
    assert '"camera" passed to lookupTransform argument source_frame does not exist.' in out
    assert "Frame laser exists with parent base.\n" in out


def test_the_frames_are_drawn_as_a_tree(graph: Any, robot: Any, tmp_path: Path) -> None:
    code, out, _ = graph.trundle("tf", "tree", "-t", "0.5")
    assert code == 0
    first, second, third = out.splitlines()
    assert first == "odom"
    assert second.startswith("└─ base  (")
    assert second.endswith(" s old, by /robot)")
    assert third == "   └─ laser  (static, by /robot)"
    target = tmp_path / "frames.svg"
    assert graph.trundle("tf", "tree", "-t", "0.5", "-o", str(target))[1].endswith(f"{target} generated\n")
    assert {"odom", "base", "laser"} <= {text.text for text in parse_xml(target.read_text(), name="x").all("text")}
    target = tmp_path / "frames.gv"
    assert graph.trundle("tf", "tree", "-t", "0.5", "-o", str(target))[0] == 0
    assert '"odom" -> "base"[label="Broadcaster: /robot\\nAverage rate: ' in target.read_text()
    assert graph.trundle("tf", "tree", "-o", "frames.pdf")[0] == 1


def test_faults_of_the_tree_are_warnings(graph: Any, robot: Any) -> None:
    one, two = graph.node("one"), graph.node("two")
    broadcasters = TransformBroadcaster(one), TransformBroadcaster(two)

    async def publish_both() -> None:
        while True:
            for parent, broadcaster in zip(("map", "world"), broadcasters, strict=True):
                broadcaster.send_transform(Transform(parent=parent, child="camera", stamp_ns=one.clock.now_ns()))
            await WallClock().sleep(0.01)

    publishing = graph.loop.spawn(publish_both())
    error = ""
    while not error.count("alternating parents"):  # until both have published
        code, _, error = graph.trundle("tf", "tree", "-t", "0.2")
        assert code == 0
    publishing.cancel()
    assert "WARNING: 2 unconnected trees; roots: " in error
    assert (
        "WARNING: 'camera' has alternating parents: 'map' (by /one) and 'world' (by /two); a frame must have one parent"
        in error
    )


def test_delays_and_rates_are_measured(graph: Any, robot: Any) -> None:
    code, out, _ = graph.trundle("tf", "monitor", "-n", "1")
    assert code == 0
    assert "RESULTS: for all Frames\n\nFrames:\nFrame: base published by /robot Average Delay: " in out
    assert "\nAll Broadcasters:\nNode: /robot " in out


def test_the_chain_between_two_frames_is_measured(graph: Any, robot: Any) -> None:
    code, out, error = graph.trundle("tf", "monitor", "laser", "/odom", "-n", "1")
    assert (code, error) == (0, "")
    first_line, _, table = out.partition("\n")
    assert first_line.startswith("Waiting for transform chain to become available between laser and /odom ")
    assert "RESULTS: for laser to /odom\nChain is: laser -> base -> odom\nNet delay     avg = " in table
    assert "\nFrames:\nFrame: base published by /robot " in table
    assert graph.trundle("tf", "monitor", "laser")[0] == 2


def test_rate_and_precision_are_private_parameters(graph: Any, robot: Any) -> None:
    code, out, _ = graph.trundle("tf", "echo", "base", "laser", "-n", "2", "_precision:=1", "_rate:=200", "__name:=me")
    assert code == 0
    assert out.startswith("Precision default value was overriden, new value: 1\nAt time 0.0\n- Translation: [0.5, 0.0")
    assert graph.trundle("tf", "echo", "a", "b", "_rate:=fast")[0] == 1


def test_a_tree_without_transforms_is_an_error(graph: Any) -> None:
    assert graph.trundle("tf", "tree", "-t", "0.1") == (1, "", "ERROR: no tf data received\n")


def test_a_static_transform_is_published(graph: Any) -> None:
    messages: list[Any] = []
    graph.node("n").subscribe("/tf_static", "tf2_msgs/TFMessage", messages.append)
    words = ["0", "-0.5", "1e-1", "0", "0", "0", "base", "laser"]
    with subprocess.Popen([sys.executable, "-m", "trundle", "tf", "static", *words], stderr=subprocess.PIPE) as process:
        try:
            graph.until(lambda: messages)
            process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE_S) == 0
        finally:
            process.kill()
    transform = messages[0].transforms[0]
    assert (transform.header.frame_id, transform.child_frame_id) == ("base", "laser")
    assert (transform.transform.translation.y, transform.transform.translation.z) == (-0.5, 0.1)
    assert graph.trundle("tf", "static", "1", "2")[0] == 1
