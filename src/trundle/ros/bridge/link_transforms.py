"""True poses of all links on /tf and /tf_static."""

import numpy as np
from numpy.typing import NDArray

from trundle.robots.model import World
from trundle.ros import Node, StaticTransformBroadcaster, Transform, TransformBroadcaster
from trundle.sim.simulation import Snapshot
from trundle.spatial import conjugate_rows, multiply_rows, rotate_rows

from .frame_names import LinkFrame, link_frames


class LinkTransforms:
    """Broadcasts each link's pose in its parent; fixed ones once, on /tf_static."""

    period_ns = 20_000_000
    """Period of 50 Hz, robot_state_publisher's default."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, world: World, start: Snapshot
    ) -> None:
        """Send the static transforms, and prepare the others.

        Args:
            node: node that publishes /tf.
            static_broadcaster: broadcaster of the node's /tf_static.
            world: world with the links.
            start: initial state.
        """
        self._broadcaster = TransformBroadcaster(node)
        self._static_broadcaster = static_broadcaster
        self.set_world(world, start)

    def set_world(self, world: World, now: Snapshot) -> None:
        """Update the frames after a change of the world, and send its static transforms.

        Args:
            world: world with the links.
            now: present state.
        """
        frames = link_frames(world)
        self._moving = [frame for frame in frames if frame.is_moving]
        self._children = _children(self._moving)
        self._parents = _parents(self._moving)
        fixed = [frame for frame in frames if not frame.is_moving]
        poses = relative_poses(now.poses, _parents(fixed), _children(fixed))
        self._static_broadcaster.send_transform(*_transforms(fixed, poses, now.time_ns))

    def enabled(self) -> bool:
        """True if there are moving frames and subscribers."""
        return bool(self._moving) and self._broadcaster.has_subscribers

    def after_step(self, snapshot: Snapshot) -> None:
        """Send the transforms of moving frames."""
        poses = relative_poses(snapshot.poses, self._parents, self._children)
        self._broadcaster.send_transform(*_transforms(self._moving, poses, snapshot.time_ns))


def _children(frames: list[LinkFrame]) -> NDArray[np.intp]:
    return np.array([f.link for f in frames], dtype=np.intp)


def _parents(frames: list[LinkFrame]) -> NDArray[np.intp]:
    return np.array([-1 if f.parent_link is None else f.parent_link for f in frames], dtype=np.intp)


def _transforms(frames: list[LinkFrame], poses: NDArray[np.float64], stamp_ns: int) -> list[Transform]:
    return [
        Transform(
            parent=frame.parent,
            child=frame.frame,
            stamp_ns=stamp_ns,
            translation=(x, y, z),
            rotation=(qw, qx, qy, qz),
        )
        for frame, (x, y, z, qw, qx, qy, qz) in zip(frames, poses.tolist(), strict=True)
    ]


def relative_poses(
    world_poses: NDArray[np.float64], parents: NDArray[np.intp], children: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Return parent_from_child for each pair, (n, 7) x y z qw qx qy qz; parent −1 is the world."""
    child = world_poses[children]
    parent = np.where((parents < 0)[:, None], _IDENTITY, world_poses[parents])
    inverse = conjugate_rows(parent[:, 3:])
    result = np.empty_like(child)
    result[:, :3] = rotate_rows(inverse, child[:, :3] - parent[:, :3])
    result[:, 3:] = multiply_rows(inverse, child[:, 3:])
    return result


_IDENTITY = np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
