"""States of many worlds, the argument of a task's functions."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError, no_such
from trundle.live.loaded_simulation import LoadedSimulation
from trundle.sim.physics import Batch
from trundle.spatial import NS_PER_S, conjugate_rows, rotate_rows

_Array = NDArray[np.float64]


class WorldStates:
    """Current states of the worlds of an environment; every array has a row for each world.

    Names are `model::joint` and `model::link`, or a unique suffix.
    """

    def __init__(self, simulation: LoadedSimulation, batch: Batch) -> None:
        """Wrap a batch of states of a world."""
        self.simulation = simulation
        """The world, in the state of the row of the last `reset` or `show`."""
        self.batch = batch
        self.actions: _Array = np.zeros((len(batch.states), 0))
        """(rows, numbers) last action of each world; zero after a reset."""
        self._axes = lru_cache(self._find_axes)

    @property
    def rows(self) -> int:
        """Number of worlds."""
        return len(self.batch.states)

    @property
    def time_s(self) -> _Array:
        """(rows,) simulation time since the reset [s]."""
        return self.batch.time_s

    def joint_positions(self, *joints: str) -> _Array:
        """Return (rows, axes) positions [rad or m].

        Raises:
            UsageError: no such joint, or a ball joint.
        """
        return self.batch.positions(self.axes(*joints))

    def joint_velocities(self, *joints: str) -> _Array:
        """Return (rows, axes) velocities [rad/s or m/s].

        Raises:
            UsageError: no such joint.
        """
        return self.batch.velocities(self.axes(*joints))

    def link_poses(self, link: str) -> _Array:
        """Return (rows, 7) poses of a link's frame in the world: x y z [m], qw qx qy qz.

        Raises:
            UsageError: no such link.
        """
        return self.batch.poses[:, self.link_index(link)]

    def link_twists(self, link: str) -> _Array:
        """Return (rows, 6) velocities of a link frame's origin [m/s] and angular velocities [rad/s], world axes.

        Raises:
            UsageError: no such link.
        """
        return self.batch.twists[:, self.link_index(link)]

    def link_positions(self, link: str, *, relative_to: str | None = None) -> _Array:
        """Return (rows, 3) positions of a link's frame [m].

        Args:
            link: name.
            relative_to: link whose frame the positions are in; None: the world.

        Raises:
            UsageError: no such link.
        """
        positions = self.link_poses(link)[:, :3]
        if relative_to is None:
            return positions
        frames = self.link_poses(relative_to)
        return rotate_rows(conjugate_rows(frames[:, 3:]), positions - frames[:, :3])

    def axes(self, *joints: str) -> Sequence[int]:
        """Return the indices of the joints' axes.

        Raises:
            UsageError: no such joint, or a ball joint, which has no axes.
        """
        return self._axes(joints)

    def _find_axes(self, joints: tuple[str, ...]) -> Sequence[int]:
        compiled = self.simulation.engine.compiled
        indices = [find_name(name, compiled.joint_names, "joint") for name in joints]
        axes = [axis for joint in indices for axis in compiled.joint_axes[joint]]
        for name, joint in zip(joints, indices, strict=True):
            if any(compiled.axis_actuator[axis] < 0 for axis in compiled.joint_axes[joint]):
                raise UsageError(f"joint {name!r} is a ball joint, which has no axes; observe its link's pose")
            if not compiled.joint_axes[joint]:
                raise UsageError(f"joint {name!r} cannot move")
        return axes

    def link_index(self, link: str) -> int:
        """Return the index of a link in `batch.poses`.

        Raises:
            UsageError: no or several matches; the message lists the names.
        """
        return find_name(link, self.simulation.engine.compiled.link_names, "link")

    def show(self, row: int) -> LoadedSimulation:
        """Return the simulation in the state of a row, for sensors and pictures."""
        self.simulation.engine.set_row_state(self.batch.states[row])
        return self._set_time_of(row)

    def show_links(self, row: int) -> LoadedSimulation:
        """Return the simulation with the link poses of a row, for ray sensors; the caller must invalidate its reader
        afterwards.
        """
        self.simulation.engine.reader.show_link_poses(self.batch.poses[row])
        return self._set_time_of(row)

    def _set_time_of(self, row: int) -> LoadedSimulation:
        simulation = self.simulation
        simulation.set_step(round(float(self.time_s[row]) * NS_PER_S / simulation.step_ns))
        return simulation


def find_name(name: str, names: Sequence[str], kind: str) -> int:
    """Return the index of `name` in the names, or of the only name that ends in `::name`.

    Raises:
        UsageError: no or several matches; the message lists them.
    """
    matches = [i for i, other in enumerate(names) if other == name]
    matches = matches or [i for i, other in enumerate(names) if other.endswith(f"::{name}")]
    if len(matches) == 1:
        return matches[0]
    if matches:
        raise UsageError(f"several {kind}s are called {name!r}; write one of {', '.join(names[i] for i in matches)}")
    raise UsageError(no_such(f"no {kind}", name, names))
