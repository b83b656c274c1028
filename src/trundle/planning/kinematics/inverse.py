"""Inverse kinematics of a group."""

import math
from collections.abc import Callable

import numpy as np
from msgspec import Struct
from numpy.typing import ArrayLike, NDArray

from trundle.base.diagnostics import UsageError
from trundle.planning import _planning
from trundle.planning.robot_model import RobotModel
from trundle.spatial import Pose

from .forward import Kinematics, Numbers, default_tip, pose_row
from .solver_settings import KinematicsSettings

ITERATIONS_PER_SECOND = 400_000
"""Iterations that a second of timeout stands for, about what a processor does in it, so that the same request has the
same answer on every machine.
"""
MAX_TIMEOUT_S = 60.0
_TYPES = ("Speed", "Distance", "Manip1", "Manip2")
StateCheck = _planning.StateCheck | Callable[[NDArray[np.float64]], bool]


class IkSolution(Struct, frozen=True, kw_only=True):
    """Result of solving the inverse kinematics of one pose."""

    is_found: bool
    positions: NDArray[np.float64]
    """State with the group's variables set; without a solution, the one with the smallest error."""
    position_error: float
    """[m]"""
    rotation_error: float
    """[rad]; 0 if only the position counts."""
    iterations: int
    """Iterations spent."""
    attempts: int
    """Number of states from which the search began: the seed, then random ones."""
    refused: int
    """Number of solutions that `valid` refused."""


class InverseKinematics:
    """Solver for the pose of one tip: damped least squares within the joint limits, from the seed, then random states.

    The damping is that of Sugihara, "Solvability-Unconcerned Inverse Kinematics by the Levenberg–Marquardt Method"
    (2011); columns at a limit are left out of a step. The same request has the same answer.
    """

    def __init__(
        self,
        model: RobotModel | Kinematics,
        group: str,
        tip: str | None = None,
        *,
        link_from_tip: Pose | None = None,
        settings: KinematicsSettings | None = None,
    ) -> None:
        """Take a group.

        Args:
            model: robot, or its kinematics.
            group: group's name.
            tip: link at or below the group's joints; None: the settings' tip, or the group's.
            link_from_tip: frame in the tip link; None: the link's own.
            settings: of kinematics.yaml.

        Raises:
            UsageError: no such group or link; the group has no tip of its own, or does not move this one.
        """
        self.kinematics = model if isinstance(model, Kinematics) else Kinematics(model)
        self.model = self.kinematics.model
        self.group = self.model.group(group)
        self.settings = KinematicsSettings() if settings is None else settings
        self.tip = tip or self.settings.tip or default_tip(self.group)
        offset = Pose() if link_from_tip is None else link_from_tip
        self._chain = self.kinematics.group_kinematics(self.group, self.tip, offset)
        self._chain.configure(
            self.settings.position_only,
            self.settings.epsilon,
            _TYPES.index(self.settings.solve_type),
            self.settings.seed,
        )
        self._indices = self.model.indices(self.group.variables)

    def solve(
        self,
        pose: Pose | ArrayLike,
        seed: Numbers,
        *,
        timeout: float | None = None,
        valid: StateCheck | None = None,
        consistency: ArrayLike | None = None,
    ) -> Numbers | None:
        """Return a state with the tip at a pose, or None; see `search`."""
        solution = self.search(pose, seed, timeout=timeout, valid=valid, consistency=consistency)
        return solution.positions if solution.is_found else None

    def search(
        self,
        pose: Pose | ArrayLike,
        seed: Numbers,
        *,
        timeout: float | None = None,
        valid: StateCheck | None = None,
        consistency: ArrayLike | None = None,
    ) -> IkSolution:
        """Look for a state with the tip at a pose.

        Args:
            pose: pose of the tip in the model frame; as an array x, y, z [m], qx, qy, qz, qw.
            seed: state (variables,) from which the search begins; other groups' joints stay there.
            timeout: [s], counted as `ITERATIONS_PER_SECOND`; None: the settings'. One attempt is always made.
            valid: must accept a solution's state, such as one without collisions; counts as 20 iterations.
            consistency: greatest distance from the seed, for each of the group's variables [rad, m].

        Raises:
            UsageError: a pose or state that is not finite, or of another size.
        """
        row = np.ascontiguousarray(pose_row(pose) if isinstance(pose, Pose) else pose, dtype=np.float64)
        state = np.ascontiguousarray(seed, dtype=np.float64)
        tolerances = np.ascontiguousarray([] if consistency is None else consistency, dtype=np.float64)
        seconds = min(self.settings.timeout if timeout is None else timeout, MAX_TIMEOUT_S)
        iterations = 0 if math.isnan(seconds) else int(max(seconds, 0.0) * ITERATIONS_PER_SECOND)
        try:
            found = self._chain.solve(row, state, iterations, tolerances, valid)
        except (ValueError, TypeError) as error:
            raise UsageError(f"inverse kinematics of {self.group.name!r}: {error}") from None
        positions = state.copy()
        positions[self._indices] = found.columns
        return IkSolution(
            is_found=found.is_found,
            positions=self.model.with_mimics(positions),
            position_error=found.position_error,
            rotation_error=found.rotation_error,
            iterations=found.iterations,
            attempts=found.attempts,
            refused=found.refused,
        )
