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


def _at(seconds: float, x: float, *, yaw: float = 0.0, parent: str = "odom", child: str = "base") -> Transform:
    return Transform(
        parent=parent,
        child=child,
        stamp_ns=round(seconds * S),
        translation=(x, 0.0, 0.0),
        rotation=quaternion_from_rpy(0.0, 0.0, yaw),
    )


def test_a_lookup_says_where_the_source_is_in_the_target() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 2.0, yaw=math.pi / 2))
    buffer.set_transform(_at(0, 1.0, parent="base", child="laser"), static=True)
    assert buffer.lookup_transform("odom", "laser").translation == pytest.approx((2.0, 1.0, 0.0))
    back = buffer.lookup_transform("laser", "odom")
    assert (back.pose @ buffer.lookup_transform("odom", "laser").pose).position == pytest.approx((0.0, 0.0, 0.0))
    assert (back.parent, back.child, back.stamp_ns) == ("laser", "odom", S)


def test_between_two_times_it_is_interpolated() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 0.0, yaw=0.0))
    buffer.set_transform(_at(2, 1.0, yaw=1.0))
    found = buffer.lookup_transform("odom", "base", round(1.25 * S))
    assert found.translation == pytest.approx((0.25, 0.0, 0.0))
    assert Pose(quaternion=found.rotation).rpy[2] == pytest.approx(0.25)


def test_a_turn_takes_the_short_way() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 0.0, yaw=3.0))
    buffer.set_transform(_at(2, 0.0, yaw=-3.0))
    assert abs(buffer.lookup_transform("odom", "base", round(1.5 * S)).pose.rpy[2]) == pytest.approx(math.pi)


def test_nothing_is_guessed_outside_what_is_known() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 0.0))
    buffer.set_transform(_at(2, 0.0))
    with pytest.raises(TransformError, match="into the future"):
        buffer.lookup_transform("odom", "base", 3 * S)
    with pytest.raises(TransformError, match="into the past"):
        buffer.lookup_transform("odom", "base", 1)


def test_the_latest_common_time_is_that_of_the_oldest_link() -> None:
    buffer = TransformBuffer()
    for seconds in (1, 2, 3):
        buffer.set_transform(_at(seconds, float(seconds)))
    buffer.set_transform(_at(0.5, 0.0, parent="base", child="arm"))
    buffer.set_transform(_at(2, 0.0, parent="base", child="arm"))
    found = buffer.lookup_transform("odom", "arm")
    assert (found.stamp_ns, found.translation[0]) == (2 * S, 2.0)


def test_ten_seconds_are_kept_and_static_transforms_for_ever() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 0.0))
    buffer.set_transform(_at(20, 0.0))
    buffer.set_transform(_at(1, 0.0, parent="base", child="laser"), static=True)
    with pytest.raises(TransformError, match="only time 20"):
        buffer.lookup_transform("odom", "base", 5 * S)
    assert not buffer.set_transform(_at(5, 0.0))
    assert buffer.can_transform("odom", "laser")


def test_the_first_transform_of_a_stamp_is_kept() -> None:
    """As tf2 does, which names repeated data and ignores it."""
    buffer = TransformBuffer()
    assert buffer.set_transform(_at(1, 2.0))
    assert not buffer.set_transform(_at(1, 3.0))
    assert buffer.lookup_transform("odom", "base").translation[0] == 2.0


def test_a_common_ancestor_is_found_where_the_frames_above_it_lack_the_time() -> None:
    """tf2 looks between two frames no farther up than where they meet."""
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 0.0, parent="odom", child="base"))
    for child, x in (("left", 1.0), ("right", 3.0)):
        for seconds in (4, 6):
            buffer.set_transform(_at(seconds, x, parent="base", child=child))
    assert buffer.lookup_transform("left", "right", 5 * S).translation == (2.0, 0.0, 0.0)


def test_a_leading_slash_is_stripped() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 2.0, parent="/odom", child="/base"))
    assert buffer.lookup_transform("/odom", "base").translation[0] == 2.0
    assert buffer.frames() == {"base": "odom", "odom": None}


def test_what_is_not_there_is_named() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 0.0))
    buffer.set_transform(_at(1, 0.0, parent="map", child="other"))
    with pytest.raises(TransformError, match='"nope" passed to lookupTransform argument source_frame does not exist'):
        buffer.lookup_transform("odom", "nope")
    with pytest.raises(TransformError, match="'odom' and 'map' because they are not part of the same tree"):
        buffer.lookup_transform("odom", "map")


@pytest.mark.parametrize("bad", [_at(1, math.nan), _at(1, 0.0, parent="base"), _at(1, 0.0, parent="")])
def test_a_transform_of_no_use_is_left_out(bad: Transform) -> None:
    buffer = TransformBuffer()
    assert not buffer.set_transform(bad)
    assert buffer.frames() == {}


def test_a_loop_is_found() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 0.0, parent="a", child="b"))
    buffer.set_transform(_at(1, 0.0, parent="b", child="a"))
    buffer.set_transform(_at(1, 0.0))
    with pytest.raises(TransformError, match="loop"):
        buffer.lookup_transform("odom", "b")


def test_a_loop_of_an_earlier_time_is_found() -> None:
    """Both frames have another parent now, so that the tree of now is no loop."""
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 0.0, parent="a", child="b"))
    buffer.set_transform(_at(1, 0.0, parent="b", child="a"))
    for child in ("a", "b"):
        buffer.set_transform(_at(2, 0.0, child=child))
    with pytest.raises(TransformError, match="loop"):
        buffer.lookup_transform("odom", "a", S)


def test_a_frame_of_another_tree_at_that_time_is_not_connected() -> None:
    buffer = TransformBuffer()
    buffer.set_transform(_at(1, 0.0, parent="map"))
    buffer.set_transform(_at(2, 0.0, parent="odom"))
    with pytest.raises(TransformError, match="'odom' and 'base' because they are not part of the same tree"):
        buffer.lookup_transform("odom", "base", S)


def test_tf_travels_between_nodes(graph: Any, far: Any) -> None:
    node, reader = graph.node("n"), far.node("reader")
    clock = SimClock(far.loop)
    clock.set(5 * S)
    reader.clock = clock
    listener = TransformListener(reader)
    static = StaticTransformBroadcaster(node)
    static.send_transform(_at(0, 1.0, parent="base", child="laser"))
    static.send_transform(_at(0, 2.0, parent="base", child="camera"))
    moving = TransformBroadcaster(node)

    def arrived() -> bool:
        moving.send_transform(_at(1, 4.0, yaw=0.5))
        return listener.buffer.can_transform("odom", "laser") and listener.buffer.can_transform("odom", "camera")

    graph.until(arrived)
    found = listener.buffer.lookup_transform("odom", "base")
    assert found.translation == (4.0, 0.0, 0.0)
    assert Pose(quaternion=found.rotation).rpy[2] == pytest.approx(0.5)
    moving.send_transform(_at(2, 9.0))
    graph.until(
        lambda: listener.buffer.lookup_transform("odom", "base").translation[0] == 9.0
    )  # nothing is under way any more
    clock.set(0)
    graph.until(lambda: not listener.buffer.can_transform("odom", "base"))
    assert listener.buffer.is_static("laser")
