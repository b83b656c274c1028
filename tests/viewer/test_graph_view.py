"""A robot is placed by tf's frames; missing frames are reported in rviz' words."""

import math

import numpy as np
import pytest

from trundle.model import Box
from trundle.render import Scene, Shape
from trundle.ros import Transform, TransformBuffer
from trundle.viewer import DEFAULT_CONFIG, RvizConfig
from trundle.viewer.graph_view import FrameTree, graph_scene, graph_state

_ROBOT = Scene(
    bodies=("base_link", "wheel", "antenna"), shapes=(Shape(name="hull", body=0, geometry=Box((1.0, 1.0, 1.0))),)
)


def _moved(parent: str, child: str, x: float, stamp_ns: int = 1) -> Transform:
    return Transform(parent=parent, child=child, stamp_ns=stamp_ns, translation=(x, 0.0, 0.0))


@pytest.fixture
def buffer() -> TransformBuffer:
    buffer = TransformBuffer()
    buffer.set_transform(_moved("odom", "base_link", 1.0, stamp_ns=5))
    buffer.set_transform(_moved("base_link", "wheel", 0.25, stamp_ns=3))
    buffer.set_transform(_moved("elsewhere", "island", 9.0), static=True)
    return buffer


def test_poses_are_given_from_the_root_of_the_fixed_frame(buffer: TransformBuffer) -> None:
    """The page itself turns them into the fixed frame, which a person may switch."""
    tree = FrameTree.of(buffer, "wheel")

    state = graph_state(tree, buffer, _ROBOT, time_ns=7)

    assert tree.root == "odom"
    assert state.body_poses[0, :3] == pytest.approx([1.0, 0.0, 0.0])
    assert state.body_poses[1, :3] == pytest.approx([1.25, 0.0, 0.0])
    assert np.isnan(state.body_poses[2]).all()
    assert state.status == ("No transform from [antenna] to [wheel]",)


def test_frames_of_another_tree_are_listed_without_a_pose(buffer: TransformBuffer) -> None:
    tree = FrameTree.of(buffer, "odom")

    scene = graph_scene(tree, _ROBOT, DEFAULT_CONFIG, title="car")
    state = graph_state(tree, buffer, _ROBOT, time_ns=7)

    assert [frame.name for frame in scene.frames] == ["base_link", "elsewhere", "island", "odom", "wheel"]
    assert state.frame_poses is not None
    assert np.isnan(state.frame_poses[:, 0]).tolist() == [False, True, True, False, False]


def test_a_fixed_frame_nobody_publishes_hides_everything(buffer: TransformBuffer) -> None:
    """The links do not complain one by one."""
    tree = FrameTree.of(buffer, "map")

    state = graph_state(tree, buffer, _ROBOT, time_ns=7)

    assert tree.root == "map"
    assert np.isnan(state.body_poses).all()
    assert state.status == ("Fixed Frame [map] does not exist",)


@pytest.mark.parametrize(("expects", "said"), [(True, 1), (False, 0)])
def test_a_page_of_windows_alone_misses_no_frames(expects: bool, said: int) -> None:
    """turtlesim has none; a robot with missing frames is reported."""
    empty = TransformBuffer()
    tree = FrameTree.of(empty, "base_link")

    assert len(graph_state(tree, empty, Scene(bodies=(), shapes=()), time_ns=7, expects_frames=expects).status) == said
    assert len(graph_state(tree, empty, _ROBOT, time_ns=7, expects_frames=expects).status) == 1


def test_a_loop_in_tf_ends(buffer: TransformBuffer) -> None:
    buffer.set_transform(_moved("wheel", "odom", 1.0))

    state = graph_state(FrameTree.of(buffer, "odom"), buffer, _ROBOT, time_ns=7)

    assert state.body_poses.shape == (3, 7)


def test_many_missing_transforms_are_counted() -> None:
    robot = Scene(bodies=tuple(f"link_{i}" for i in range(10)), shapes=())
    buffer = TransformBuffer()
    buffer.set_transform(_moved("odom", "base_link", 1.0))

    status = graph_state(FrameTree.of(buffer, "odom"), buffer, robot, time_ns=0).status

    assert status[0] == "No transform from [link_0] to [odom]"
    assert status[-1] == "… and 7 more links without a transform"
    assert len(status) == 4


def test_displays_that_are_off_are_not_drawn(buffer: TransformBuffer) -> None:
    scene = graph_scene(FrameTree.of(buffer, "odom"), _ROBOT, RvizConfig(), title="car")

    assert scene.scene.shapes == ()
    assert not scene.show_frames
    assert not scene.show_path


def test_a_quarter_turn_arrives_as_wxyz(buffer: TransformBuffer) -> None:
    half = math.sqrt(0.5)
    buffer.set_transform(Transform(parent="odom", child="base_link", stamp_ns=9, rotation=(half, 0.0, 0.0, half)))

    state = graph_state(FrameTree.of(buffer, "odom"), buffer, _ROBOT, time_ns=7)

    assert state.body_poses[0, 3:] == pytest.approx([half, 0.0, 0.0, half])
    assert state.body_poses[1, :3] == pytest.approx([0.0, 0.25, 0.0])
