"""Observations: values of the state that an agent gets."""

from collections.abc import Callable, Sequence
from typing import Any, Protocol, TypeAlias

import numpy as np
from gymnasium import spaces
from numpy.typing import ArrayLike, NDArray

from .states import WorldStates

_Array = NDArray[np.float64]
_Function: TypeAlias = Callable[[WorldStates], NDArray[np.float64]]
Generators: TypeAlias = Sequence[np.random.Generator]


class ObservationReader(Protocol):
    """Reader of an observation of many worlds."""

    @property
    def space(self) -> "spaces.Box[Any]":
        """Bounds of one world's values."""
        ...

    def read(self) -> NDArray[np.generic]:
        """Return the current values, with a row for each world."""
        ...

    def reset(self, row: int) -> None:
        """Begin an episode of a world."""
        ...


class Observation(Protocol):
    """Part of an observation."""

    def reader(self, states: WorldStates, random: Generators) -> ObservationReader:
        """Return a reader.

        Args:
            states: states of all worlds.
            random: generator of each world, replaced by `reset`.

        Raises:
            UsageError: a name that does not exist.
        """
        ...


class StateReader:
    """Reader that computes an observation from the present states alone."""

    def __init__(self, call: _Function, states: WorldStates, low: ArrayLike, high: ArrayLike) -> None:
        self._call = call
        self._states = states
        self.space = spaces.Box(np.asarray(low, dtype=np.float32), np.asarray(high, dtype=np.float32), dtype=np.float32)

    def read(self) -> NDArray[np.float32]:
        """Return the values within the bounds."""
        values = self._call(self._states).astype(np.float32)
        return np.clip(values, self.space.low, self.space.high)

    def reset(self, row: int) -> None:
        """Do nothing."""


class JointPositions:
    """Positions of joints [rad or m], bounded by their limits."""

    def __init__(self, *joints: str) -> None:
        self.joints = joints

    def reader(self, states: WorldStates, random: Generators) -> ObservationReader:
        """See `Observation`."""
        del random
        limits = states.simulation.engine.compiled.axis_range[list(states.axes(*self.joints))]
        return StateReader(lambda states: states.joint_positions(*self.joints), states, limits[:, 0], limits[:, 1])


class JointVelocities:
    """Velocities of joints [rad/s or m/s], unbounded."""

    def __init__(self, *joints: str) -> None:
        self.joints = joints

    def reader(self, states: WorldStates, random: Generators) -> ObservationReader:
        """See `Observation`."""
        del random
        infinity = np.full(len(states.axes(*self.joints)), np.inf)
        return StateReader(lambda states: states.joint_velocities(*self.joints), states, -infinity, infinity)


class LinkPosition:
    """Position of a link's frame [m], in the world or in another link's frame."""

    def __init__(self, link: str, *, relative_to: str | None = None) -> None:
        self.link = link
        self.relative_to = relative_to

    def reader(self, states: WorldStates, random: Generators) -> ObservationReader:
        """See `Observation`."""
        del random
        for name in filter(None, (self.link, self.relative_to)):
            states.link_index(name)
        infinity = np.full(3, np.inf)
        return StateReader(
            lambda states: states.link_positions(self.link, relative_to=self.relative_to), states, -infinity, infinity
        )


class LinkPose:
    """Pose of a link's frame in the world: x y z [m], qw qx qy qz."""

    def __init__(self, link: str) -> None:
        self.link = link

    def reader(self, states: WorldStates, random: Generators) -> ObservationReader:
        """See `Observation`."""
        del random
        states.link_index(self.link)
        high = np.array([np.inf] * 3 + [1.0] * 4)
        return StateReader(lambda states: states.link_poses(self.link), states, -high, high)


class LinkTwist:
    """Velocity of a link frame's origin [m/s] and its angular velocity [rad/s], world axes."""

    def __init__(self, link: str) -> None:
        self.link = link

    def reader(self, states: WorldStates, random: Generators) -> ObservationReader:
        """See `Observation`."""
        del random
        states.link_index(self.link)
        infinity = np.full(6, np.inf)
        return StateReader(lambda states: states.link_twists(self.link), states, -infinity, infinity)


class Computed:
    """Values of a function of the states, clipped to its bounds."""

    def __init__(self, call: _Function, *, low: ArrayLike, high: ArrayLike) -> None:
        """Compute an observation.

        Args:
            call: function that returns (rows, values).
            low: smallest values, (values,).
            high: largest values, (values,).
        """
        self.call = call
        self.low = low
        self.high = high

    def reader(self, states: WorldStates, random: Generators) -> ObservationReader:
        """See `Observation`."""
        del random
        return StateReader(self.call, states, self.low, self.high)
