"""Joint space of a model: positions and velocities as arrays, and the equations of motion.

The order is that of `joint_names`: the file's, one entry per axis. A fixed joint has none, a universal joint two, a
ball joint three.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from trundle.base.arguments import described
from trundle.base.diagnostics import UsageError
from trundle.sim.physics import Coordinates, Engine, JointState
from trundle.spatial import Vector3

from .joint_handle import JointHandle

_Array = NDArray[np.float64]


class JointSpace:
    """Axes of one model; created again when models are spawned or deleted."""

    def __init__(self, engine: Engine, model: str, *, links: Sequence[int], joints: Sequence[JointHandle]) -> None:
        """Find the axes.

        Args:
            engine: simulation's engine.
            model: model's name.
            links: indices of the model's links.
            joints: joints of the model, in file order.
        """
        self._engine = engine
        self._model = model
        self._links = links
        spans = [joint.axes for joint in joints]
        movable = [span for span in spans if span]
        self.axes = range(movable[0].start, movable[-1].stop) if movable else range(0)
        """Indices into the engine's axes, contiguous per model."""
        self.names = tuple(joint.name for joint, span in zip(joints, spans, strict=True) for _ in span)

    def positions(self) -> _Array:
        """Return (axes,) positions [rad or m]; a ball joint's three are its rotation vector."""
        return _read_only(self._engine.reader.positions_of_all(self.axes))

    def velocities(self) -> _Array:
        """Return (axes,) velocities [rad/s or m/s]."""
        return _read_only(self._engine.reader.velocities_of(self.axes))

    def set_positions(self, positions: ArrayLike) -> None:
        """Set every position at once; velocities stay.

        Raises:
            UsageError: the array has another shape, or a number that is not finite.
        """
        self._engine.writer.set_axis_positions(self.axes, self._array("joint_positions", positions, len(self.axes)))

    def set_velocities(self, velocities: ArrayLike) -> None:
        """Set every velocity once.

        Raises:
            UsageError: the array has another shape, or a number that is not finite.
        """
        self._engine.writer.set_axis_velocities(self.axes, self._array("joint_velocities", velocities, len(self.axes)))

    def jacobian(self, link: int, point: Vector3) -> _Array:
        """See `ModelHandle.jacobian`; `link` is an index."""
        state = JointState(*self._engine.reader.state())
        return self._engine.dynamics.jacobian(state, self._coordinates, link=link, point=point)

    def mass_matrix(self) -> _Array:
        """See `ModelHandle.mass_matrix`."""
        return self._engine.dynamics.mass_matrix(JointState(*self._engine.reader.state()), self._coordinates)

    def bias_forces(self) -> _Array:
        """See `ModelHandle.bias_forces`."""
        coordinates = self._coordinates
        state = JointState(*self._engine.reader.state())
        return self._engine.dynamics.inverse_dynamics(state, coordinates, np.zeros(self._width))

    def inverse_dynamics(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> _Array:
        """See `ModelHandle.inverse_dynamics`."""
        qpos, qvel = self._engine.reader.state()
        width = self._width
        state = JointState(qpos, qvel, self._array("q", q, len(self.axes)), self._array("v", v, width))
        return self._engine.dynamics.inverse_dynamics(state, self._coordinates, self._array("a", a, width))

    @property
    def _coordinates(self) -> Coordinates:
        return Coordinates(tuple(link for link in self._links if self._engine.writer.is_free(link)), self.axes)

    @property
    def _width(self) -> int:
        return 6 * len(self._coordinates.free_links) + len(self.axes)

    def _array(self, argument: str, values: ArrayLike, count: int) -> _Array:
        try:
            array = np.asarray(values, dtype=np.float64)
        except (TypeError, ValueError):
            array = None
        if array is None or array.shape != (count,):
            bases = (count - len(self.axes)) // 6
            names = ", ".join(map(repr, self.names)) or "none"
            free = f", after 6 for each of {bases} free links" if bases else ""
            got = (
                f"is no array of numbers: {described(values)}; its shape is"
                if array is None
                else f"has shape {array.shape}, not"
            )
            raise UsageError(f"model {self._model!r}: {argument} {got} ({count},): joints: {names}{free}")
        if not np.isfinite(array).all():
            raise UsageError(f"model {self._model!r}: {argument} has numbers that are not finite: {array}")
        return array


def _read_only(values: Sequence[float]) -> _Array:
    """Return a read-only array: assigning an entry would not change the simulation."""
    array = np.array(values)
    array.flags.writeable = False
    return array
