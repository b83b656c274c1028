"""The transform buffer, and tf between nodes."""

import math
from typing import Any

import pytest

from trundle.ros import (
    SimClock,
    StaticTransformBroadcaster,
    Transform,
    TransformBroadcaster,
    TransformBuffer,
    TransformError,
    TransformListener,
)
from trundle.spatial import Pose, quaternion_from_rpy

S = 1_000_000_000


def _transform(seconds: float, x: float, *, yaw: float = 0.0, parent: str = "odom", child: str = "base") -> Transform:
    return Transform(
        parent=parent,
        child=child,
        stamp_ns=round(seconds * S),
        translation=(x, 0.0, 0.0),
        rotation=quaternion_from_rpy(0.0, 0.0, yaw),
    )


def test_a_lookup_returns_the_pose_of_the_source_in_the_target() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 2.0, yaw=math.pi / 2))
    buffer.set_transform(_transform(0, 1.0, parent="base", child="laser"), static=True)
    assert buffer.lookup_transform("odom", "laser").translation == pytest.approx((2.0, 1.0, 0.0))
    back = buffer.lookup_transform("laser", "odom")
    assert (back.pose @ buffer.lookup_transform("odom", "laser").pose).position == pytest.approx((0.0, 0.0, 0.0))
    assert (back.parent, back.child, back.stamp_ns) == ("laser", "odom", S)


def test_transforms_are_interpolated_between_two_times() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 0.0, yaw=0.0))
    buffer.set_transform(_transform(2, 1.0, yaw=1.0))
    transform = buffer.lookup_transform("odom", "base", round(1.25 * S))
    assert transform.translation == pytest.approx((0.25, 0.0, 0.0))
    assert Pose(quaternion=transform.rotation).rpy[2] == pytest.approx(0.25)


def test_rotations_are_interpolated_along_the_shorter_arc() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 0.0, yaw=3.0))
    buffer.set_transform(_transform(2, 0.0, yaw=-3.0))
    assert abs(buffer.lookup_transform("odom", "base", round(1.5 * S)).pose.rpy[2]) == pytest.approx(math.pi)


def test_a_time_outside_the_history_is_refused() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 0.0))
    buffer.set_transform(_transform(2, 0.0))
    with pytest.raises(TransformError, match="into the future"):
        buffer.lookup_transform("odom", "base", 3 * S)
    with pytest.raises(TransformError, match="into the past"):
        buffer.lookup_transform("odom", "base", 1)


def test_the_latest_common_time_is_the_oldest_of_the_newest_stamps() -> None:
    buffer = TransformBuffer()
    for seconds in (1, 2, 3):
        buffer.set_transform(_transform(seconds, float(seconds)))
    buffer.set_transform(_transform(0.5, 0.0, parent="base", child="arm"))
    buffer.set_transform(_transform(2, 0.0, parent="base", child="arm"))
    transform = buffer.lookup_transform("odom", "arm")
    assert (transform.stamp_ns, transform.translation[0]) == (2 * S, 2.0)


def test_transforms_expire_after_ten_seconds_except_static_ones() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 0.0))
    buffer.set_transform(_transform(20, 0.0))
    buffer.set_transform(_transform(1, 0.0, parent="base", child="laser"), static=True)
    with pytest.raises(TransformError, match="only time 20"):
        buffer.lookup_transform("odom", "base", 5 * S)
    assert not buffer.set_transform(_transform(5, 0.0))
    assert buffer.can_transform("odom", "laser")


def test_a_second_transform_of_a_stamp_is_ignored() -> None:
    """As in tf2, which warns of repeated data and ignores it."""
    buffer = TransformBuffer()
    assert buffer.set_transform(_transform(1, 2.0))
    assert not buffer.set_transform(_transform(1, 3.0))
    assert buffer.lookup_transform("odom", "base").translation[0] == 2.0


def test_frames_above_the_common_ancestor_need_no_data_at_the_time() -> None:
    """tf2 does not search above the common ancestor of two frames."""
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 0.0, parent="odom", child="base"))
    for child, x in (("left", 1.0), ("right", 3.0)):
        for seconds in (4, 6):
            buffer.set_transform(_transform(seconds, x, parent="base", child=child))
    assert buffer.lookup_transform("left", "right", 5 * S).translation == (2.0, 0.0, 0.0)


def test_a_leading_slash_is_stripped() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 2.0, parent="/odom", child="/base"))
    assert buffer.lookup_transform("/odom", "base").translation[0] == 2.0
    assert buffer.frames() == {"base": "odom", "odom": None}


def test_unknown_and_unconnected_frames_are_reported() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 0.0))
    buffer.set_transform(_transform(1, 0.0, parent="map", child="other"))
    with pytest.raises(TransformError, match='"nope" passed to lookupTransform argument source_frame does not exist'):
        buffer.lookup_transform("odom", "nope")
    with pytest.raises(TransformError, match="'odom' and 'map' because they are not part of the same tree"):
        buffer.lookup_transform("odom", "map")


@pytest.mark.parametrize(
    "transform", [_transform(1, math.nan), _transform(1, 0.0, parent="base"), _transform(1, 0.0, parent="")]
)
def test_invalid_transforms_are_refused(transform: Transform) -> None:
    buffer = TransformBuffer()
    assert not buffer.set_transform(transform)
    assert buffer.frames() == {}


def test_a_loop_is_reported() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 0.0, parent="a", child="b"))
    buffer.set_transform(_transform(1, 0.0, parent="b", child="a"))
    buffer.set_transform(_transform(1, 0.0))
    with pytest.raises(TransformError, match="loop"):
        buffer.lookup_transform("odom", "b")


def test_a_loop_at_an_earlier_time_is_reported() -> None:
    """Both frames have another parent later, so that the latest tree has no loop."""
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 0.0, parent="a", child="b"))
    buffer.set_transform(_transform(1, 0.0, parent="b", child="a"))
    for child in ("a", "b"):
        buffer.set_transform(_transform(2, 0.0, child=child))
    with pytest.raises(TransformError, match="loop"):
        buffer.lookup_transform("odom", "a", S)


def test_a_frame_of_another_tree_at_the_requested_time_is_not_connected() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_transform(1, 0.0, parent="map"))
    buffer.set_transform(_transform(2, 0.0, parent="odom"))
    with pytest.raises(TransformError, match="'odom' and 'base' because they are not part of the same tree"):
        buffer.lookup_transform("odom", "base", S)


def test_tf_is_published_from_node_to_node(graph: Any, far: Any) -> None:
    node, reader = graph.node("n"), far.node("reader")
    clock = SimClock(far.loop)
    clock.set(5 * S)
    reader.clock = clock
    listener = TransformListener(reader)
    static = StaticTransformBroadcaster(node)
    static.send_transform(_transform(0, 1.0, parent="base", child="laser"))
    static.send_transform(_transform(0, 2.0, parent="base", child="camera"))
    moving = TransformBroadcaster(node)

    def arrived() -> bool:
        moving.send_transform(_transform(1, 4.0, yaw=0.5))
        return listener.buffer.can_transform("odom", "laser") and listener.buffer.can_transform("odom", "camera")

    graph.until(arrived)
    transform = listener.buffer.lookup_transform("odom", "base")
    assert transform.translation == (4.0, 0.0, 0.0)
    assert Pose(quaternion=transform.rotation).rpy[2] == pytest.approx(0.5)
    moving.send_transform(_transform(2, 9.0))
    graph.until(
        lambda: listener.buffer.lookup_transform("odom", "base").translation[0] == 9.0
    )  # no message is in transit
    clock.set(0)
    graph.until(lambda: not listener.buffer.can_transform("odom", "base"))
    assert listener.buffer.is_static("laser")
