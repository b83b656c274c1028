"""The robot: its groups, joints and links."""

from typing import Any

from moveit_msgs.msg import RobotState
from visualization_msgs.msg import MarkerArray

from moveit_ros_planning_interface import _moveit_robot_interface
from moveit_ros_planning_interface.serialization import from_bytes, to_bytes

from . import conversions
from .exception import MoveItCommanderException
from .move_group import MoveGroupCommander


class Joint:
    """One joint; its present value is asked for."""

    def __init__(self, robot: "RobotCommander", name: str) -> None:
        """Bind a joint of a robot."""
        self._robot = robot
        self._name = name

    def name(self) -> str:
        """Return the name."""
        return self._name

    def _limits(self) -> list[list[float]]:
        return self._robot._r.get_joint_limits(self._name)

    def variable_count(self) -> int:
        """Return the number of variables."""
        return len(self._limits())

    def bounds(self) -> Any:
        """Return [lower, upper]; several variables have a list each."""
        limits = self._limits()
        return limits[0] if len(limits) == 1 else limits

    def min_bound(self) -> Any:
        """Return the lower limit; several variables have one each."""
        limits = [limit[0] for limit in self._limits()]
        return limits[0] if len(limits) == 1 else limits

    def max_bound(self) -> Any:
        """Return the upper limit; several variables have one each."""
        limits = [limit[1] for limit in self._limits()]
        return limits[0] if len(limits) == 1 else limits

    def value(self) -> Any:
        """Return the present position; several variables have one each."""
        values = self._robot._r.get_current_joint_values(self._name)
        return values[0] if len(values) == 1 else values

    def move(self, position: Any, wait: bool = True) -> bool:
        """Move the joint to a position, by the smallest group that has it; True if that succeeded."""
        group = self._robot.get_default_owner_group(self._name)
        if group is None:
            raise MoveItCommanderException(f"There is no known group containing joint {self._name}. Cannot move.")
        commander = self._robot.get_group(group)
        commander.set_joint_value_target(commander.get_current_joint_values())
        commander.set_joint_value_target(self._name, position)
        return commander.go(wait)


class Link:
    """One link; its present pose is asked for."""

    def __init__(self, robot: "RobotCommander", name: str) -> None:
        """Bind a link of a robot."""
        self._robot = robot
        self._name = name

    def name(self) -> str:
        """Return the name."""
        return self._name

    def pose(self) -> Any:
        """Return the present geometry_msgs/PoseStamped in the planning frame."""
        numbers = self._robot._r.get_link_pose(self._name)
        return conversions.list_to_pose_stamped(numbers, self._robot.get_planning_frame())


class RobotCommander:
    """The robot of a `robot_description`; groups and joints are attributes as well."""

    Joint = Joint
    Link = Link

    def __init__(self, robot_description: str = "robot_description", ns: str = "") -> None:
        """Read the model.

        Raises:
            RuntimeError: the parameters are missing or invalid.
        """
        self._robot_description = robot_description
        self._ns = ns
        self._r = _moveit_robot_interface.RobotInterface(robot_description, ns)
        self._groups: dict[str, MoveGroupCommander] = {}
        self._joint_owner_groups: dict[str, str | None] = {}

    def get_planning_frame(self) -> str:
        """Return the frame of plans."""
        return self._r.get_planning_frame()

    def get_robot_name(self) -> str:
        """Return the name in the URDF."""
        return self._r.get_robot_name()

    def get_robot_markers(self, *args: Any) -> Any:
        """Return visualization_msgs/MarkerArray of the robot, by default at its present state.

        Args:
            args: a moveit_msgs/RobotState; positions by joint, with or without links; a list of links; or a group.
        """
        if not args:
            data = self._r.get_robot_markers()
        elif isinstance(args[0], RobotState):
            data = self._r.get_robot_markers(to_bytes(args[0]))
        elif isinstance(args[0], dict):
            data = self._r.get_robot_markers(*args)
        elif isinstance(args[0], str):
            data = self._r.get_group_markers(args[0])
        elif isinstance(args[0], list | tuple):
            data = self._r.get_robot_markers(list(args[0]))
        else:
            raise MoveItCommanderException("Unexpected type")
        return from_bytes(MarkerArray, data)

    def get_root_link(self) -> str:
        """Return the root link."""
        return self._r.get_robot_root_link()

    def get_active_joint_names(self, group: str | None = None) -> list[str]:
        """Return the joints that move by themselves, of the robot or a group."""
        if group is None:
            return self._r.get_active_joint_names()
        return self._r.get_group_active_joint_names(self._known(group))

    def get_joint_names(self, group: str | None = None) -> list[str]:
        """Return the joints, fixed ones too, of the robot or a group."""
        return self._r.get_joint_names() if group is None else self._r.get_group_joint_names(self._known(group))

    def get_link_names(self, group: str | None = None) -> list[str]:
        """Return the links, of the robot or a group."""
        return self._r.get_link_names() if group is None else self._r.get_group_link_names(self._known(group))

    def _known(self, group: str) -> str:
        if not self.has_group(group):
            raise MoveItCommanderException(f"There is no group named {group}")
        return group

    def get_group_names(self) -> list[str]:
        """Return the groups of the SRDF."""
        return self._r.get_group_names()

    def get_current_state(self) -> Any:
        """Return the present moveit_msgs/RobotState."""
        return from_bytes(RobotState, self._r.get_current_state())

    def get_current_variable_values(self) -> dict[str, float]:
        """Return the present positions of all variables."""
        return self._r.get_current_variable_values()

    def get_joint(self, name: str) -> Joint:
        """Return a joint."""
        if name not in self.get_joint_names():
            raise MoveItCommanderException(f"There is no joint named {name}")
        return self.Joint(self, name)

    def get_link(self, name: str) -> Link:
        """Return a link."""
        if name not in self.get_link_names():
            raise MoveItCommanderException(f"There is no link named {name}")
        return self.Link(self, name)

    def get_group(self, name: str) -> MoveGroupCommander:
        """Return the commander of a group; the same one each time."""
        if name not in self._groups:
            known = self._known(name)
            self._groups[known] = MoveGroupCommander(known, self._robot_description, self._ns)
        return self._groups[name]

    def has_group(self, name: str) -> bool:
        """True if the SRDF has the group."""
        return self._r.has_group(name)

    def get_default_owner_group(self, joint_name: str) -> str | None:
        """Return the smallest group that has a joint; None: no group has it."""
        if joint_name not in self._joint_owner_groups:
            owners = [
                (len(joints), name)
                for name in self.get_group_names()
                if joint_name in (joints := self._r.get_group_joint_names(name))
            ]
            self._joint_owner_groups[joint_name] = min(owners)[1] if owners else None
        return self._joint_owner_groups[joint_name]

    def __getattr__(self, name: str) -> Any:
        """Return the group, or else the joint or link, of a name."""
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self.get_group_names():
            return self.get_group(name)
        if name in self.get_joint_names():
            return self.Joint(self, name)
        if name in self.get_link_names():
            return self.Link(self, name)
        raise AttributeError(f"the robot has no group, joint or link {name!r}")
