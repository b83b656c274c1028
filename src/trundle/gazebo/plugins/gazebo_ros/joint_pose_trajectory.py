"""libgazebo_ros_joint_pose_trajectory.so: joint positions set one after the other, without dynamics."""

from collections import deque
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import TagParameters
from trundle.ros import Node, to_nsec
from trundle.sim.simulation import ModelHandle, Simulation

from .namespaces import rate_to_period_ns
from .ros_plugin import RosPlugin, plugin_names

if TYPE_CHECKING:
    from trundle.ros.message_types import gazebo_msgs, trajectory_msgs

_MAX_POINTS = 100_000


class JointPoseTrajectory(RosPlugin):
    """Sets the positions of trajectory points, each at the end of the time_from_start of the one before.

    Parameters, with gazebo_ros' defaults: <topicName> set_joint_trajectory, <serviceName> set_joint_trajectory,
    <updateRate> 0 (every step).
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        self._sim, self._model, self._node = sim, model, node
        names = plugin_names(sim, model, node, parameters)
        topic = parameters.text("topicName", "set_joint_trajectory")
        service = names.topic(parameters.text("serviceName", "set_joint_trajectory"))
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", 0.0))
        self._due: deque[tuple[int, dict[str, float]]] = deque()
        names.subscribe(topic, "trajectory_msgs/JointTrajectory", self._on_trajectory, queue_size=100)
        node.advertise_service(service, "gazebo_msgs/SetJointTrajectory", self._set_trajectory)

    def before_step(self, sim: Simulation) -> None:
        """Set the positions that are due; in one update those of one point, as in gazebo_plugins."""
        if self._due and self._due[0][0] <= sim.time_ns:
            for name, position in self._due.popleft()[1].items():
                joint = self._model.joint(name)
                joint.set_position(position)
                joint.set_velocity(0.0)

    def reset(self) -> None:
        """Drop the remaining points."""
        self._due.clear()

    def _on_trajectory(self, trajectory: "trajectory_msgs.JointTrajectory") -> None:
        try:
            self._plan(trajectory)
        except UsageError as error:
            self._node.log.error(str(error))

    def _set_trajectory(self, request: "gazebo_msgs.SetJointTrajectoryRequest") -> dict[str, Any]:
        try:
            self._plan(request.joint_trajectory)
        except UsageError as error:
            return {"success": False, "status_message": str(error)}
        return {"success": True, "status_message": "set trajectory"}

    def _plan(self, trajectory: "trajectory_msgs.JointTrajectory") -> None:
        names = [str(name) for name in trajectory.joint_names]
        for name in names:
            if not self._model.joint(name).is_driven:
                raise UsageError(f"joint {name!r} has no axis to drive")
        if len(trajectory.points) > _MAX_POINTS:
            raise UsageError(f"{len(trajectory.points)} points are more than {_MAX_POINTS}")
        if any(len(point.positions) != len(names) for point in trajectory.points):
            raise UsageError(f"each point needs {len(names)} positions")
        due_ns = max(to_nsec(trajectory.header.stamp), self._sim.time_ns)
        self._due.clear()
        for point in trajectory.points:
            self._due.append((due_ns, {name: float(p) for name, p in zip(names, point.positions, strict=True)}))
            due_ns += to_nsec(point.time_from_start)
