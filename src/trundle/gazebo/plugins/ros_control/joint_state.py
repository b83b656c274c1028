"""joint_state_controller/JointStateController: publishes the states of all joints."""

import math
from typing import Self

from .controller import ControllerContext, Endpoints, InStepController, PublishTimer
from .transmissions import Interface

_STATES = ("position", "velocity", "effort")


class JointStateController(InStepController):
    """Publishes `<robot>/joint_states` at `publish_rate`: joints by name, then `extra_joints`."""

    def __init__(self, context: ControllerContext) -> None:
        self.claims: dict[Interface | str, list[str]] = {}
        settings = context.settings
        names = settings.texts("joints")
        self._joints = [context.joint(name, None) for name in names] or [
            context.hardware[name] for name in sorted(context.hardware)
        ]
        extra = settings.sections("extra_joints")
        self._names = [joint.name for joint in self._joints] + [joint.text("name") for joint in extra]
        self._extra = {name: [joint.number(name, 0.0) for joint in extra] for name in _STATES}
        self._timer = PublishTimer(settings.number("publish_rate", above=0.0))
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
        self._timer.skip(time_ns, dt)
        if not self._timer.due(time_ns) or not self._states.has_subscribers:
            return
        self._states.publish(
            {
                "header": {"stamp": time_ns},
                "name": self._names,
                "position": [j.position for j in self._joints] + self._extra["position"],
                "velocity": [j.velocity for j in self._joints] + self._extra["velocity"],
                "effort": [j.effort for j in self._joints] + self._extra["effort"],
            }
        )

    def due_ns(self, time_ns: int) -> float:
        """Return the time of the next message [ns]."""
        del time_ns
        return self._timer.next_ns if self._states.has_subscribers else math.inf

    def stop(self) -> None:
        """Do nothing: no joint is commanded."""

    def close(self) -> None:
        """Unregister its topic."""
        self._endpoints.close()
