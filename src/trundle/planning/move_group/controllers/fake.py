"""moveit_fake_controller_manager: joints that are where they should be, for demonstrations without a robot."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, cast, get_args

import numpy as np

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, Publisher
from trundle.spatial import NS_PER_S

from .joint_path import JointPath
from .outcome import Outcome

if TYPE_CHECKING:
    from trundle.planning.robot_model import RobotModel

_Type = Literal["interpolate", "via points", "last point"]
_TYPES: tuple[str, ...] = get_args(_Type)


class FakeController:
    """Publishes joint states along a path: interpolated, at its points, or at its end alone."""

    is_active = True

    def __init__(
        self, node: Node, publisher: Publisher, name: str, joints: Sequence[str], kind: _Type, *, rate_hz: float
    ) -> None:
        """Make a controller.

        Args:
            node: node whose clock counts.
            publisher: of sensor_msgs/JointState.
            name: name in controller_list.
            joints: joints that it moves.
            kind: what is published.
            rate_hz: rate of `interpolate`.
        """
        self.name = name
        self.joints = tuple(joints)
        self.is_default = False
        self._node = node
        self._publisher = publisher
        self._kind = kind
        self._period_s = 1.0 / rate_hz

    async def execute(self, path: JointPath) -> Outcome:
        """Publish the states along a path."""
        self._node.log.info("Fake execution of trajectory")
        if len(path.times_s) == 0:
            return Outcome.SUCCEEDED
        clock = self._node.clock
        start_ns = clock.now_ns()
        if self._kind == "interpolate":
            while (elapsed_s := (clock.now_ns() - start_ns) / NS_PER_S) < path.duration_s:
                self._publish(path, path.at(elapsed_s))
                await clock.sleep(min(self._period_s, path.duration_s - elapsed_s))
        elif self._kind == "via points":
            for time_s, positions in zip(path.times_s, path.positions, strict=True):
                await clock.sleep_until(start_ns + round(float(time_s) * NS_PER_S))
                self._publish(path, positions)
        self._publish(path, path.positions[-1])
        return Outcome.SUCCEEDED

    def _publish(self, path: JointPath, positions: Any) -> None:
        header = {"stamp": self._node.clock.now_ns()}
        self._publisher.publish(
            {"header": header, "name": list(path.joints), "position": np.asarray(positions).tolist()}
        )


class FakeControllers:
    """The controllers of ~controller_list; publishes the states of ~initial first."""

    def __init__(self, node: Node, parameters: RosParameters, model: "RobotModel") -> None:
        """Read the list.

        Raises:
            ParamError: an entry is invalid.
        """
        publisher = node.advertise(
            "~fake_controller_joint_states", "sensor_msgs/JointState", latch=True, queue_size=100
        )
        rate_hz = parameters.number("fake_interpolating_controller_rate", 10.0, above=0.0)
        self._controllers: list[FakeController] = []
        for entry in parameters.sections("controller_list"):
            name, joints = entry.text("name", ""), entry.texts("joints")
            kind = entry.text("type", "last point")
            if not name:
                raise ParamError(f"{entry.namespace}: a controller needs a name")
            if kind not in _TYPES:
                node.log.error(
                    f"Unknown fake controller type: {kind}; types: {', '.join(_TYPES)}. 'last point' is used"
                )
                kind = "last point"
            self._controllers.append(FakeController(node, publisher, name, joints, cast(_Type, kind), rate_hz=rate_hz))
        if not self._controllers:
            node.log.error("No controller_list specified.")
        positions = _initial_positions(node, parameters, model)
        if positions:
            header = {"stamp": node.clock.now_ns()}
            state = {"header": header, "name": list(positions), "position": list(positions.values())}
            publisher.publish(state)

    async def controllers(self) -> Sequence[FakeController]:
        """Return the controllers of the list."""
        return self._controllers

    async def activate(self, controllers: Sequence[object]) -> bool:
        """True: all are always active."""
        del controllers
        return True


def _initial_positions(node: Node, parameters: RosParameters, model: "RobotModel") -> dict[str, float]:
    """Return the positions of the states that ~initial names, for each group."""
    positions: dict[str, float] = {}
    for entry in parameters.sections("initial"):
        group_name, state_name = entry.text("group", ""), entry.text("pose", "")
        group = model.groups.get(group_name)
        if group is None:
            node.log.warn(f"Unknown joint model group: {group_name}")
            continue
        state = group.default_states.get(state_name)
        if state is None:
            known = ", ".join(group.default_states) or "none"
            node.log.warn(f"Unknown pose '{state_name}' for group '{group_name}'; poses: {known}.")
            continue
        node.log.info(f"Set joints of group '{group_name}' to pose '{state_name}'.")
        positions.update({name: float(value) for name, value in state.items() if "/" not in name})
    return positions
