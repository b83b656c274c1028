"""Actions: drive joints by the numbers of an agent's action."""

import math
from collections.abc import Callable
from typing import Protocol, TypeAlias

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError

from .states import WorldStates

_Array = NDArray[np.float64]
Apply: TypeAlias = Callable[[_Array], None]
"""Takes (rows, numbers) within the bounds."""


class Action(Protocol):
    """Part of an action."""

    def bind(self, states: WorldStates) -> tuple[spaces.Box, Apply]:
        """Return the action's bounds, from the limits in the description, and the function that applies it.

        Raises:
            UsageError: a name that does not exist, or a joint without a bound.
        """
        ...


class PositionAction:
    """Target positions of joints [rad or m], bounded by their limits; approached as `command_position` does."""

    def __init__(self, *joints: str, max_effort: float = math.inf) -> None:
        self.joints = joints
        self.max_effort = max_effort

    def bind(self, states: WorldStates) -> tuple[spaces.Box, Apply]:
        """See `Action`."""
        axes = states.axes(*self.joints)
        limits = states.simulation.engine.compiled.axis_range[list(axes)]

        def apply(values: _Array) -> None:
            for i, axis in enumerate(axes):
                states.batch.command_position(axis, values[:, i], self.max_effort)

        return _action_space(self, limits[:, 0], limits[:, 1], "limits; use VelocityAction"), apply


class VelocityAction:
    """Target velocities of joints [rad/s or m/s]."""

    def __init__(self, *joints: str, max_velocity: float = math.inf, max_effort: float = math.inf) -> None:
        """Drive joints.

        Args:
            joints: names.
            max_velocity: upper bound in addition to the joint's limit.
            max_effort: motor effort [N·m or N]; upper bound in addition to the joint's limit.
        """
        self.joints = joints
        self.max_velocity = max_velocity
        self.max_effort = max_effort

    def bind(self, states: WorldStates) -> tuple[spaces.Box, Apply]:
        """See `Action`."""
        axes = states.axes(*self.joints)
        high = np.minimum(states.simulation.engine.compiled.axis_velocity[list(axes)], self.max_velocity)

        def apply(values: _Array) -> None:
            for i, axis in enumerate(axes):
                states.batch.command_velocity(axis, values[:, i], self.max_effort)

        return _action_space(self, -high, high, "velocity limit; give max_velocity"), apply


class EffortAction:
    """Efforts on joints [N·m or N]."""

    def __init__(self, *joints: str, max_effort: float = math.inf) -> None:
        """Drive joints.

        Args:
            joints: names.
            max_effort: upper bound in addition to the joint's limit.
        """
        self.joints = joints
        self.max_effort = max_effort

    def bind(self, states: WorldStates) -> tuple[spaces.Box, Apply]:
        """See `Action`."""
        axes = states.axes(*self.joints)
        high = np.minimum(states.simulation.engine.compiled.axis_effort[list(axes)], self.max_effort)

        def apply(values: _Array) -> None:
            for i, axis in enumerate(axes):
                states.batch.command_effort(axis, values[:, i])

        return _action_space(self, -high, high, "effort limit; give max_effort"), apply


def _action_space(
    action: PositionAction | VelocityAction | EffortAction, low: _Array, high: _Array, missing: str
) -> spaces.Box:
    if not (np.isfinite(low).all() and np.isfinite(high).all()):
        raise UsageError(f"{type(action).__name__}({', '.join(map(repr, action.joints))}): a joint has no {missing}")
    return spaces.Box(low.astype(np.float32), high.astype(np.float32), dtype=np.float32)
