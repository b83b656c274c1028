"""Builder of a joint."""

from typing import Self

from msgspec.structs import replace

from trundle.base.diagnostics import UsageError, no_such
from trundle.base.documented import documented
from trundle.robots import model
from trundle.robots.model import ForceTorque, JointAxis, JointType, Sensor
from trundle.spatial import Pose, Quaternion, normalized, rotate

from .names import BUILT, check_name
from .sensors import make_sensor

_AXES = {JointType.FIXED: 0, JointType.BALL: 0, JointType.UNIVERSAL: 2, JointType.REVOLUTE2: 2}
"""Number of axes per joint type; 1 for the others."""
_BUILT = [kind for kind in JointType if kind not in (JointType.PLANAR, JointType.GEARBOX)]


@documented("add_force_torque_sensor")
class Joint:
    """Joint between two links, or a link and the world; created by `Model.add_joint`."""

    __module__ = "trundle"

    def __init__(
        self,
        name: str,
        type: str,
        parent: str,
        child: str,
        *,
        pose: Pose,
        axes: tuple[JointAxis | None, JointAxis | None],
    ) -> None:
        """Validate the type and its axes; see `Model.add_joint`."""
        types = {kind.value: kind for kind in _BUILT}
        if type not in types:
            raise UsageError(no_such(f"joint {name!r}: no type", type, list(types)))
        self.name = name
        self._type = types[type]
        self.parent, self.child, self._pose = parent, child, pose
        count = _AXES.get(self._type, 1)
        self._axes = tuple(_unit(axis, name) for axis in axes[:count])
        if count == 2 and axes[1] is None:
            raise UsageError(f"joint {name!r}: type {type!r} needs axis2 as well")
        self._sensors: list[Sensor] = []

    def add_force_torque_sensor(
        self,
        name: str,
        settings: ForceTorque | None = None,
        *,
        update_rate: float = 0.0,
        always_on: bool = False,
        topic: str = "",
    ) -> Self:
        """Add a force-torque sensor.

        Args:
            name: sensor's name.
            settings: axes, direction and noise.
            update_rate: [Hz]; 0: at every step.
            always_on: keep the update schedule without subscribers.
            topic: topic name; empty: Gazebo's default.

        Raises:
            UsageError: the name is taken.
        """
        check_name(name, self._sensors, f"joint {self.name!r}")
        self._sensors.append(
            make_sensor(
                name,
                "force_torque",
                settings,
                pose=Pose(),
                update_rate=update_rate,
                always_on=always_on,
                visualize=False,
                topic=topic,
            )
        )
        return self

    def description(self, model_from_child: Pose) -> model.Joint:
        """Return the joint as a reader would, with axes in the model frame."""
        turn = (model_from_child @ self._pose).quaternion
        first, second = (*self._axes, None, None)[:2]
        return model.Joint(
            name=self.name,
            type=self._type,
            parent=self.parent,
            child=self.child,
            at=BUILT,
            child_from_joint=self._pose,
            axis=_turned(first, turn),
            axis2=_turned(second, turn),
            sensors=tuple(self._sensors),
        )

    def __repr__(self) -> str:
        return f"<Joint {self.name!r}: {self._type.value}, {self.parent!r} to {self.child!r}>"


def _unit(axis: JointAxis | None, joint: str) -> JointAxis | None:
    if axis is None:
        return None
    direction = normalized(axis.direction)
    if direction is None:
        raise UsageError(f"joint {joint!r}: {axis.direction} is no direction")
    return replace(axis, direction=direction)


def _turned(axis: JointAxis | None, turn: Quaternion) -> JointAxis | None:
    return None if axis is None else replace(axis, direction=rotate(turn, axis.direction))
