"""Timed elastic bands and bands of bubbles, in C++; the optimizations do not hold the GIL."""

from typing import TypeAlias

from numpy import float64, uint8
from numpy.typing import NDArray

_Triple: TypeAlias = tuple[float, float, float]

class BandSettings:
    """Parameters of teb_local_planner by their names."""

    dt_ref: float
    dt_hysteresis: float
    max_vel_x: float
    max_vel_x_backwards: float
    max_vel_y: float
    max_vel_trans: float
    max_vel_theta: float
    acc_lim_x: float
    acc_lim_y: float
    acc_lim_theta: float
    min_turning_radius: float
    min_obstacle_dist: float
    inflation_dist: float
    obstacle_association_force_inclusion_factor: float
    obstacle_association_cutoff_factor: float
    penalty_epsilon: float
    weight_adapt_factor: float
    obstacle_cost_exponent: float
    weight_max_vel_x: float
    weight_max_vel_y: float
    weight_max_vel_theta: float
    weight_acc_lim_x: float
    weight_acc_lim_y: float
    weight_acc_lim_theta: float
    weight_kinematics_nh: float
    weight_kinematics_forward_drive: float
    weight_kinematics_turning_radius: float
    weight_optimaltime: float
    weight_shortest_path: float
    weight_viapoint: float
    weight_obstacle: float
    weight_inflation: float
    min_samples: int
    max_samples: int
    no_inner_iterations: int
    no_outer_iterations: int
    teb_autosize: bool
    exact_arc_length: bool
    free_goal_vel: bool

class BubbleSettings:
    """Parameters of eband_local_planner by their names without `eband_`, and the robot's radius [m]."""

    robot_radius: float
    min_relative_overlap: float
    tiny_bubble_expansion: float
    internal_force_gain: float
    external_force_gain: float
    significant_force_lower_bound: float
    num_iterations_eband_optimization: int
    equilibrium_approx_max_recursion_depth: int

class RobotBody:
    """Outline of a robot as lines with a radius."""

    def __init__(self, lines: NDArray[float64], *, is_closed: bool) -> None:
        """Make a body of lines (n, 5): start x, y, end x, y, radius [m] in the robot's frame.

        Args:
            lines: at least one.
            is_closed: True: the lines are the sides of a polygon.

        Raises:
            ValueError: there are no lines, or a number is not finite.
        """

    def distance(self, pose: _Triple, point: tuple[float, float]) -> float:
        """Return the distance between the body at x, y [m], yaw [rad] and a point [m]; negative inside."""

class TimedBand:
    """Poses and the times between them."""

    def set_path(self, path: NDArray[float64], settings: BandSettings) -> None:
        """Begin with a path (n, 3), at the greatest speeds.

        Raises:
            ValueError: the path has fewer than two poses, or a number is not finite.
        """

    def move_ends(self, start: _Triple, goal: _Triple) -> None:
        """Begin at another pose, without what lies behind it, and end at another goal.

        Raises:
            ValueError: the band has no path.
        """

    def optimize(
        self,
        settings: BandSettings,
        body: RobotBody,
        obstacles: NDArray[float64],
        via_points: NDArray[float64],
        *,
        velocity: _Triple,
        obstacle_scale: float = 1.0,
    ) -> float:
        """Deform the band toward the least cost; its ends stay.

        Args:
            settings: limits and weights.
            body: the robot.
            obstacles: (n, 2) [m].
            via_points: (n, 2) points to pass [m].
            velocity: of the robot at the start, ahead and sideways [m/s], turning [rad/s].
            obstacle_scale: scale of the obstacles' costs in the result.

        Returns:
            The cost; infinite where it is not a number.

        Raises:
            ValueError: the band has no path, or a number is not finite.
        """

    @property
    def poses(self) -> NDArray[float64]:
        """(n, 3): x, y [m], yaw [rad]."""

    @property
    def steps(self) -> NDArray[float64]:
        """(n - 1,) times from each pose to the next [s]."""

def obstacle_outline(costs: NDArray[uint8]) -> NDArray[float64]:
    """Return columns and rows (n, 2) of lethal cells beside others."""

def obstacle_islands(costs: NDArray[uint8]) -> NDArray[float64]:
    """Return a cell (n, 2) of each group of inscribed and lethal cells that does not touch the grid's edge."""

def relax_bubbles(path: NDArray[float64], obstacles: NDArray[float64], settings: BubbleSettings) -> NDArray[float64]:
    """Return bubbles (n, 3) along a path: x, y, radius [m], after some rounds of forces; empty where none fits.

    Args:
        path: (n, 2), at least two points [m]; its ends stay.
        obstacles: (n, 2) [m].
        settings: forces.

    Raises:
        ValueError: the path is too short, or a number is not finite.
    """
