"""joint_state_controller/JointStateController: publishes the states of all joints."""

from typing import Self

from .controller import ControllerContext, Endpoints, PublishTimer
from .transmissions import Interface


class JointStateController:
    """Publishes `<robot>/joint_states` at `publish_rate`: joints by name, then `extra_joints`."""

    def __init__(self, context: ControllerContext) -> None:
        self.claims: dict[Interface | str, list[str]] = {}
        settings = context.settings
        named = settings.texts("joints")
        self._joints = [context.joint(name, None) for name in named] or [
            context.hardware[name] for name in sorted(context.hardware)
        ]
        self._extra = [joint for joint in settings.items("extra_joints") if isinstance(joint, dict)]
        self._names = [joint.name for joint in self._joints] + [str(joint.get("name", "")) for joint in self._extra]
        self._timer = PublishTimer(settings.rate_hz("publish_rate"))
        self._states = context.node.advertise(
            f"{context.namespace}/joint_states", "sensor_msgs/JointState", queue_size=4
        )
        self._endpoints = Endpoints()
        self._endpoints.add(self._states)

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Start a period now."""
        self._timer.restart(time_ns)

    def update(self, time_ns: int, dt: float) -> None:
        """Publish when due."""
        del dt
        if not self._timer.due(time_ns) or not self._states.has_subscribers:
            return
        self._states.publish(
            {
                "header": {"stamp": time_ns},
                "name": self._names,
                "position": [j.position for j in self._joints] + [_number(j, "position") for j in self._extra],
                "velocity": [j.velocity for j in self._joints] + [_number(j, "velocity") for j in self._extra],
                "effort": [j.effort for j in self._joints] + [_number(j, "effort") for j in self._extra],
            }
        )

    def stop(self) -> None:
        """Do nothing: no joint is commanded."""

    def close(self) -> None:
        """Unregister its topic."""
        self._endpoints.close()


def _number(joint: dict[str, object], key: str) -> float:
    value = joint.get(key, 0.0)
    return float(value) if isinstance(value, int | float) else 0.0
