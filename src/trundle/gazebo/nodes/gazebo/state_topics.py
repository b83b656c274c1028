"""/gazebo/model_states and /gazebo/link_states."""

import struct
from collections.abc import Callable, Sequence

import numpy as np

from trundle.ros import Node
from trundle.ros.bridge import StepPublisher
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, pose_from_row

from ..host import Simulator
from .entities import scoped_links

_ORDER = [0, 1, 2, 4, 5, 6, 3]
"""ROS order: x y z qx qy qz qw."""


class StateTopics:
    """Both topics, published while they have subscribers; the server publishes them while paused.

    In lockstep, a paused world is published only for new subscribers and after model changes, for repeatability.
    """

    period_s = 0.01

    def __init__(self, node: Node, simulator: Simulator) -> None:
        self._simulator = simulator
        kinds: tuple[tuple[str, str, Callable[[Simulation], _Rows]], ...] = (
            ("~model_states", "gazebo_msgs/ModelStates", _model_rows),
            ("~link_states", "gazebo_msgs/LinkStates", _link_rows),
        )
        self._topics = [_StateTopic(node, simulator, name, kind, rows) for name, kind, rows in kinds]

    def has_subscribers(self) -> bool:
        """True if either topic has subscribers."""
        return any(topic.publisher.has_subscribers for topic in self._topics)

    def publish(self) -> None:
        """Publish both topics; on the simulation's thread."""
        snapshot = self._simulator.simulation.snapshot()
        for topic in self._topics:
            topic.publish(snapshot)


class _StateTopic:
    """One of the two topics."""

    def __init__(
        self, node: Node, simulator: Simulator, name: str, kind: str, rows: "Callable[[Simulation], _Rows]"
    ) -> None:
        self.publisher = node.advertise(
            name, kind, queue_size=StepPublisher.QUEUE_SIZE, on_connect=lambda _: simulator.post(self._publish_at_rest)
        )
        self._simulator = simulator
        self._find_rows = rows
        self._rows: _Rows | None = None
        simulator.post(self._begin)

    def _begin(self) -> None:
        simulation = self._simulator.simulation
        simulation.on_change(self._change)
        StepPublisher(self.publisher, self.publish).attach(simulation)

    def _change(self) -> None:
        self._rows = None
        self._publish_at_rest()

    def _publish_at_rest(self) -> None:
        if self._simulator.is_lockstep and self._simulator.paused:
            self.publish(self._simulator.simulation.snapshot())

    def publish(self, snapshot: Snapshot) -> None:
        """Publish a snapshot, if there are subscribers."""
        if not self.publisher.has_subscribers:
            return
        if self._rows is None:
            self._rows = self._find_rows(self._simulator.simulation)
        self.publisher.publish(self._rows.message(snapshot))


class _Rows:
    """Precomputed rows of a message; serialized directly, since subscribers may need it at 1 kHz."""

    def __init__(self, rows: Sequence[tuple[str, int | None, Pose]]) -> None:
        """Prepare the rows.

        Args:
            rows: name, link index, pose in the link's frame; with index None, in the world.
        """
        self._names = _array(len(rows), b"".join(_text(name) for name, *_ in rows))
        self._count = len(rows)
        moving = [(row, link) for row, (_, link, _) in enumerate(rows) if link is not None]
        self._moving = np.array([row for row, _ in moving], dtype=np.intp)
        self._links = np.array([link for _, link in moving], dtype=np.intp)
        self._offsets = [
            (row, link, pose) for row, (_, link, pose) in enumerate(rows) if link is None or pose != Pose()
        ]

    def message(self, snapshot: Snapshot) -> bytes:
        """Return the serialized message."""
        poses, twists = np.zeros((self._count, 7)), np.zeros((self._count, 6))
        poses[self._moving] = snapshot.poses[self._links]
        twists[self._moving] = snapshot.twists[self._links]
        for row, link, offset in self._offsets:
            poses[row] = _numbers(offset if link is None else pose_from_row(poses[row]) @ offset)
        numbers = (np.ascontiguousarray(array, dtype="<f8").tobytes() for array in (poses[:, _ORDER], twists))
        return self._names + b"".join(_array(self._count, data) for data in numbers)


def _model_rows(simulation: Simulation) -> _Rows:
    """Return the rows of models; twists are the canonical link's, as in gazebo_ros."""
    return _Rows([_row(model) for model in simulation.models])


def _link_rows(simulation: Simulation) -> _Rows:
    return _Rows([(name, link.index, Pose()) for name, link in scoped_links(simulation)])


def _row(model: ModelHandle) -> tuple[str, int | None, Pose]:
    if not model.links:
        return model.name, None, model.pose
    return model.name, model.base.index, model.base.link.model_from_link.inverse()


def _numbers(pose: Pose) -> tuple[float, ...]:
    return (*pose.position, *pose.quaternion)


def _text(name: str) -> bytes:
    data = name.encode()
    return _array(len(data), data)


def _array(count: int, data: bytes) -> bytes:
    return struct.pack("<I", count) + data
