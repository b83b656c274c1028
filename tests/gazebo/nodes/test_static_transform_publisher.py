"""The static_transform_publishers of tf and tf2, by their command lines."""

import math
from collections.abc import Callable
from typing import Any

import pytest
from tests.gazebo.nodes.fakes import FakeClock, FakeNode, run_to_end

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.static_transform_publisher import Tf2StaticTransformPublisher, TfStaticTransformPublisher

S = 1_000_000_000


def run(kind: Callable[..., Any], line: str, params: dict[str, Any] | None = None) -> tuple[FakeNode, int | None]:
    node = FakeNode(FakeClock(end_ns=2 * S), params)
    node.closed.set()
    return node, run_to_end(kind(node, line.split(), NodeHost()).run())


def test_tf_publisher_repeats_one_period_ahead_and_keeps_slashes() -> None:
    node, code = run(TfStaticTransformPublisher, "1 2 3 0 0 0 /base_link /left_front_link 100")
    assert code is None
    messages = node.sent("/tf")
    assert len(messages) == 11
    (first,) = messages[0].transforms
    assert (first.header.frame_id, first.child_frame_id) == ("/base_link", "/left_front_link")
    assert first.header.stamp.sec * S + first.header.stamp.nanosec == S + S // 10
    move = first.transform.translation
    assert (move.x, move.y, move.z) == (1.0, 2.0, 3.0)


@pytest.mark.parametrize("turn", ["1.5707963267948966 0 0", "0 0 0.7071067811865476 0.7071067811865476"])
def test_a_rotation_is_yaw_pitch_roll_or_a_quaternion(turn: str) -> None:
    for kind, topic, end in (
        (TfStaticTransformPublisher, "/tf", " 100"),
        (Tf2StaticTransformPublisher, "/tf_static", ""),
    ):
        node, _ = run(kind, f"0 0 0 {turn} a b{end}")
        rotation = node.sent(topic)[0].transforms[0].transform.rotation
        half = math.sqrt(0.5)
        assert (rotation.x, rotation.y, rotation.z, rotation.w) == pytest.approx((0.0, 0.0, half, half))


def test_tf2_publisher_sends_once() -> None:
    node, code = run(Tf2StaticTransformPublisher, "1 2 3 0 0 0 a b")
    assert code == 0
    assert len(node.sent("/tf_static")) == 1


def test_tf2_publisher_reads_a_parameter() -> None:
    tree = {
        "header": {"frame_id": "a"},
        "child_frame_id": "b",
        "transform": {"translation": {"x": 1, "y": 0, "z": 0}, "rotation": {"x": 0, "y": 0, "z": 0, "w": 1}},
    }
    node, code = run(Tf2StaticTransformPublisher, "mount", {"/mount": tree})
    assert code == 0
    assert node.sent("/tf_static")[0].transforms[0].child_frame_id == "b"

    del tree["child_frame_id"]
    node, code = run(Tf2StaticTransformPublisher, "mount", {"/mount": tree})
    assert code == 255
    assert node.log.logged[-1] == (
        "fatal",
        "Could not read TF: parameter mount is not a transform: 'child_frame_id' is missing",
    )


def test_tf_publisher_reports_equal_frames_and_continues() -> None:
    node, code = run(TfStaticTransformPublisher, "0 0 0 0 0 0 a a 100")
    assert code is None
    assert ("fatal", "target_frame and source frame are the same (a, a) this cannot work") in node.log.logged
    assert node.sent("/tf")


@pytest.mark.parametrize(
    ("kind", "line", "code"),
    [
        (TfStaticTransformPublisher, "0 0 0 0 0 0 a b", 255),
        (TfStaticTransformPublisher, "0 0 0 0 0 x a b 100", 255),
        (Tf2StaticTransformPublisher, "0 0 0 0 0 0 a b 100 7", 255),
        (Tf2StaticTransformPublisher, "0 0 0 0 0 nan a b", 255),
        (Tf2StaticTransformPublisher, "0 0 0 0 0 0 a a", 1),
        (Tf2StaticTransformPublisher, "", 255),
    ],
)
def test_an_invalid_command_line_ends_it_with_an_error(kind: Callable[..., Any], line: str, code: int) -> None:
    node, exit_code = run(kind, line)
    assert exit_code == code
    assert node.log.logged[-1][0] in ("error", "fatal")
