"""joint_state_controller/JointStateController: tells where every joint is."""

from typing import Self

from .controller import Cadence, ControllerContext, Endpoints
from .transmissions import Interface


class JointStateController:
    """`<robot>/joint_states` at `publish_rate`, joints in the order of their names, then `extra_joints`."""

    def __init__(self, site: ControllerContext) -> None:
        self.claims: dict[Interface | str, list[str]] = {}
        settings = site.settings
        named = settings.texts("joints")
        self._joints = [site.joint(name, None) for name in named] or [
            site.hardware[name] for name in sorted(site.hardware)
        ]
        self._extra = [joint for joint in settings.items("extra_joints") if isinstance(joint, dict)]
        self._names = [joint.name for joint in self._joints] + [str(joint.get("name", "")) for joint in self._extra]
        self._cadence = Cadence(settings.rate_hz("publish_rate"))
        self._states = site.node.advertise(f"{site.namespace}/joint_states", "sensor_msgs/JointState", queue_size=4)
        self._ends = Endpoints()
        self._ends.add(self._states)

    @classmethod
    def make(cls, site: ControllerContext) -> Self:
        """See `Controller.make`."""
        return cls(site)

    def start(self, time_ns: int) -> None:
        """Count the period from now."""
        self._cadence.restart(time_ns)

    def update(self, time_ns: int, dt: float) -> None:
        """Publish when due."""
        del dt
        if not self._cadence.due(time_ns) or not self._states.has_subscribers:
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
        """Nothing was commanded."""

    def close(self) -> None:
        """Leave the graph."""
        self._ends.close()


def _number(joint: dict[str, object], key: str) -> float:
    value = joint.get(key, 0.0)
    return float(value) if isinstance(value, int | float) else 0.0
