"""Kinematics, collisions and planners of arms, in C++; none holds the GIL. Poses are x, y, z [m], qx, qy, qz, qw."""

from collections.abc import Callable

from numpy import float64, int64
from numpy.typing import NDArray

class StateCheck:
    """Question, asked in C++, which states are valid."""

class PoseSolution:
    """What inverse kinematics found."""

    @property
    def is_found(self) -> bool:
        """True if the error is small enough, and the check accepted it."""
    @property
    def columns(self) -> NDArray[float64]:
        """Values of the group's variables; without a solution, those with the smallest error."""
    @property
    def position_error(self) -> float:
        """[m]"""
    @property
    def rotation_error(self) -> float:
        """[rad]"""
    @property
    def iterations(self) -> int:
        """Iterations spent, with what checks count as."""
    @property
    def attempts(self) -> int:
        """Number of states from which the search began."""
    @property
    def refused(self) -> int:
        """Number of solutions that the check refused."""

class TreeKinematics:
    """Tree of links."""

    def __init__(self, joints: NDArray[int64], numbers: NDArray[float64]) -> None:
        """Take joints, parents first; link i is the child of joint i.

        Args:
            joints: (n, 4) rows of kind (0 fixed, 1 revolute, 2 prismatic, 3 planar, 4 floating), parent link (−1: the
                model frame), first variable in a state (−1: none), variable that it follows (−1: none).
            numbers: (n, 12) rows of the origin in the parent link as a pose, the axis, multiplier and offset.

        Raises:
            ValueError: a child comes before its parent.
        """

    def link_poses(self, states: NDArray[float64]) -> NDArray[float64]:
        """Return the poses (states, links, 7) of links in the model frame."""

class GroupKinematics:
    """Joints of a group to a tip."""

    def __init__(
        self,
        kinematics: TreeKinematics,
        link: int,
        tip: NDArray[float64],
        columns: NDArray[int64],
        limits: NDArray[float64],
    ) -> None:
        """Take a tip and the variables that move it.

        Args:
            kinematics: tree.
            link: link of the tip.
            tip: pose (7,) of the tip in the link's frame.
            columns: (n, 3) rows of a variable, 1 if it has limits, 1 if whole turns change nothing.
            limits: (n, 2) rows of its limits [rad] or [m].

        Raises:
            ValueError: no variable moves the tip, or a floating joint is among the group's.
        """

    def configure(self, position_only: bool, epsilon: float, solve_type: int, seed: int) -> None:
        """Set what `solve` does.

        Args:
            position_only: True: the tip's rotation is free.
            epsilon: greatest error of each component [m], [rad].
            solve_type: 0 the first solution, 1 the nearest to the state, 2 the most manipulable, 3 the best
                conditioned.
            seed: seed of random restarts.
        """

    def jacobian(self, state: NDArray[float64]) -> NDArray[float64]:
        """Return the Jacobian (6, n) of the tip's linear and angular velocity, in the model frame."""

    def solve(
        self,
        target: NDArray[float64],
        state: NDArray[float64],
        iterations: int,
        tolerances: NDArray[float64],
        check: StateCheck | Callable[[NDArray[float64]], bool] | None,
    ) -> PoseSolution:
        """Look for values of the columns that bring the tip to a pose.

        Args:
            target: pose of the tip in the model frame.
            state: where the search begins, and the values of all other variables.
            iterations: budget; each takes about a microsecond.
            tolerances: (n,) greatest distance from the state per column, or (0,): any.
            check: must accept a solution.
        """

def manipulability(jacobian: NDArray[float64]) -> tuple[float, float]:
    """Return the product of a Jacobian's singular values, and the ratio of the smallest to the largest one."""
