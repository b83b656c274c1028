"""The robot: its names, limits, named states and present state."""

from collections.abc import Sequence
from typing import Any

from moveit_msgs.msg import RobotState
from visualization_msgs.msg import MarkerArray

from .markers import link_markers
from .robot_state import SharedRobot, shared_robot
from .serialization import from_bytes, to_bytes


class RobotInterface:
    """The robot of a `robot_description`."""

    def __init__(self, robot_description: str = "robot_description", ns: str = "") -> None:
        """Read the model.

        Raises:
            RuntimeError: the parameters are missing or invalid.
        """
        self._robot: SharedRobot = shared_robot(robot_description, ns)

    def get_robot_name(self) -> str:
        """Return the name in the URDF."""
        return self._robot.model.name

    def get_robot_root_link(self) -> str:
        """Return the root link."""
        return self._robot.model.root_link

    def get_planning_frame(self) -> str:
        """Return the frame in which plans are made."""
        return self._robot.model.model_frame

    def get_group_names(self) -> list[str]:
        """Return the groups of the SRDF."""
        return list(self._robot.model.groups)

    def has_group(self, name: str) -> bool:
        """True if the SRDF has the group."""
        return name in self._robot.model.groups

    def get_joint_names(self) -> list[str]:
        """Return all joints, fixed ones too."""
        return [joint.name for joint in self._robot.model.joints]

    def get_active_joint_names(self) -> list[str]:
        """Return the joints that move by themselves."""
        return [joint.name for joint in self._robot.model.joints if joint.variables and joint.mimic is None]

    def get_group_joint_names(self, group: str) -> list[str]:
        """Return the joints of a group; none of an unknown one."""
        found = self._robot.model.groups.get(group)
        return [] if found is None else _group_joints(self._robot, found)

    def get_group_active_joint_names(self, group: str) -> list[str]:
        """Return the joints of a group that move by themselves."""
        found = self._robot.model.groups.get(group)
        return [] if found is None else list(found.joints)

    def get_group_joint_tips(self, group: str) -> list[str]:
        """Return the tips of a group."""
        found = self._robot.model.groups.get(group)
        return [] if found is None else list(found.tips)

    def get_link_names(self) -> list[str]:
        """Return all links."""
        return list(self._robot.model.links)

    def get_group_link_names(self, group: str) -> list[str]:
        """Return the links of a group."""
        found = self._robot.model.groups.get(group)
        return [] if found is None else list(found.links)

    def get_group_default_states(self, group: str) -> list[str]:
        """Return the names of a group's named states."""
        found = self._robot.model.groups.get(group)
        return [] if found is None else list(found.default_states)

    def get_joint_values(self, group: str, named_state: str) -> dict[str, float]:
        """Return the positions of a named state; none if it is unknown."""
        found = self._robot.model.groups.get(group)
        return {} if found is None else dict(found.default_states.get(named_state, {}))

    def get_joint_limits(self, name: str) -> list[list[float]]:
        """Return lower and upper limit of each variable of a joint."""
        joint = next((joint for joint in self._robot.model.joints if joint.name == name), None)
        if joint is None:
            return []
        return [[float(a), float(b)] for a, b in zip(joint.lower, joint.upper, strict=True)]

    def get_link_pose(self, name: str) -> list[float]:
        """Return x, y, z and quaternion x, y, z, w of a link; none if it is unknown."""
        if name not in self._robot.model.links:
            return []
        return self._robot.link_pose(self._robot.positions(), name)

    def get_current_joint_values(self, name: str) -> list[float]:
        """Return the positions of a joint's variables."""
        joint = next((joint for joint in self._robot.model.joints if joint.name == name), None)
        return [] if joint is None else self._robot.select(self._robot.positions(), joint.variables)

    def get_current_variable_values(self) -> dict[str, float]:
        """Return the positions of all variables."""
        values = self._robot.positions()
        return dict(zip(self._robot.model.variables, map(float, values), strict=True))

    def get_current_state(self) -> bytes:
        """Return the present moveit_msgs/RobotState."""
        return to_bytes(self._robot.message(self._robot.positions()))

    def get_end_effector_parent_group(self, name: str) -> tuple[str, str]:
        """Return parent link and group of an end effector."""
        found = self._robot.model.end_effectors.get(name)
        return ("", "") if found is None else (str(found.parent_link), str(found.parent_group or ""))

    def get_robot_markers(self, values: Any = None, links: Sequence[str] | None = None) -> bytes:
        """Return markers of links.

        Args:
            values: names of links, a serialized RobotState, or positions by joint; default: the present state.
            links: names of links; default: all.
        """
        robot = self._robot
        positions = robot.positions()
        if isinstance(values, bytes):
            positions = robot.with_message(positions, from_bytes(RobotState, values))
        elif isinstance(values, dict):
            state = RobotState()
            state.joint_state.name, state.joint_state.position = list(values), [float(v) for v in values.values()]
            positions = robot.with_message(positions, state)
        elif values is not None:
            links = list(values)
        return to_bytes(MarkerArray(link_markers(robot, positions, robot.model.links if links is None else links)))

    def get_group_markers(self, group: str) -> bytes:
        """Return markers of a group's links."""
        return self.get_robot_markers(self.get_group_link_names(group))


def _group_joints(robot: SharedRobot, group: Any) -> list[str]:
    """Return the group's joints with the fixed ones between its links and the mimic ones."""
    links = set(group.links)
    return [joint.name for joint in robot.model.joints if joint.name in group.joints or joint.child_link in links]
