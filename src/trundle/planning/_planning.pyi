"""Kinematics, collisions and planners of arms, in C++; none holds the GIL. Poses are x, y, z [m], qx, qy, qz, qw."""

from collections.abc import Callable, Sequence

from numpy import bool_, float64, int32, int64
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

class CollisionShape:
    """Box, sphere, cylinder, plane, convex hull, or the triangles of a surface."""

    @property
    def size(self) -> int:
        """Number of convex parts."""

def bind_distance(address: int) -> None:
    """Bind mj_geomDistance of the MuJoCo library that Python has loaded."""

def box_shape(x: float, y: float, z: float) -> CollisionShape:
    """Return a box of full lengths [m]."""

def sphere_shape(radius: float) -> CollisionShape:
    """Return a sphere [m]."""

def cylinder_shape(radius: float, length: float) -> CollisionShape:
    """Return a cylinder along z, centred [m]."""

def plane_shape() -> CollisionShape:
    """Return the plane through the origin with normal z, thin and without end."""

def hull_shape(corners: NDArray[float64]) -> CollisionShape:
    """Return the hull of corners (N, 3) [m], which should all be on it."""

def surface_shape(vertices: NDArray[float64], faces: NDArray[int32]) -> CollisionShape:
    """Return the triangles of faces (M, 3) of vertices (N, 3) [m]."""

_ContactRow = tuple[int, int, float, tuple[float, float, float], tuple[float, float, float]]

class CollisionWorld:
    """Bodies of pieces; threads may ask it at once and wait for each other. Link i carries body i, if it has shapes."""

    def __init__(self, kinematics: TreeKinematics, model: int, data: int) -> None:
        """Take a tree of links, and addresses of `physics.ShapePair`, which must live on."""

    def copy(self, model: int, data: int) -> CollisionWorld:
        """Return a copy with a pair of its own."""

    def set_body(
        self,
        number: int,
        link: int,
        padding: float,
        shapes: Sequence[CollisionShape],
        poses: NDArray[float64],
        frame: NDArray[float64],
    ) -> None:
        """Set a body's pieces.

        Args:
            number: body.
            link: link that carries it; -1: it is fixed in the model frame.
            padding: distance that others keep [m].
            shapes: its shapes.
            poses: (N, 7) of the shapes in the frame.
            frame: (1, 7) in the link's or the model frame.
        """

    def set_voxels(
        self,
        number: int,
        padding: float,
        centers: NDArray[float64],
        sizes: NDArray[float64],
        frame: NDArray[float64],
    ) -> None:
        """Set a body of cubes with centers (N, 3) and edges (N,) [m], in a frame (1, 7)."""

    def remove_body(self, number: int) -> None:
        """Remove a body with its allowed pairs."""

    def allow(self, a: int, b: int, is_allowed: bool) -> None:
        """Allow, or check, contacts of two bodies."""

    def is_free(self, state: NDArray[float64], links: NDArray[bool_]) -> bool:
        """Return True without contacts; with a mask of links, only of bodies that one of them carries."""

    def contacts(
        self, state: NDArray[float64], links: NDArray[bool_], max_count: int, max_per_pair: int
    ) -> list[_ContactRow]:
        """Return bodies, depth [m], position [m] and normal of contacts."""

    def nearest(
        self, state: NDArray[float64], links: NDArray[bool_], cutoff: float
    ) -> tuple[float, int, int, tuple[float, float, float], tuple[float, float, float]]:
        """Return distance [m], bodies and points of the nearest pair; bodies -1: nothing within the cutoff."""

class CollisionCheck(StateCheck):
    """States without contacts of the bodies that some links carry."""

    def __init__(self, world: CollisionWorld, links: NDArray[bool_]) -> None: ...

class CancelFlag:
    """Ends a search from another thread."""

    def __init__(self) -> None: ...
    def cancel(self) -> None:
        """End it as soon as possible."""
    @property
    def is_cancelled(self) -> bool:
        """True after `cancel`."""

class PoseConstraint:
    """Bounds of a link's position or orientation."""

class VisibilityConstraint:
    """Sight from a sensor to a disc."""

class Goal:
    """Bounds of a group's variables, and constraints."""

class GroupTask:
    """Group, limits, path constraints and resolution of a query."""

class QueryResult:
    """Result of solving the inverse kinematics of one pose."""

    @property
    def states(self) -> NDArray[float64]:
        """(N, n) values of the group; none: no path."""
    @property
    def iterations(self) -> int: ...
    @property
    def checks(self) -> int:
        """States checked."""
    @property
    def nodes(self) -> int: ...
    @property
    def goals(self) -> int:
        """States found that satisfy a goal."""
    @property
    def attempts(self) -> int:
        """Samples of the goals."""
    @property
    def unreachable(self) -> int:
        """Samples that could not be made to satisfy it."""
    @property
    def in_collision(self) -> int: ...
    @property
    def seconds_left(self) -> float: ...

def pose_constraint(
    link: int,
    frame: int,
    offset: NDArray[float64],
    regions: Sequence[CollisionShape],
    region_poses: NDArray[float64],
    orientation: int,
    target: NDArray[float64],
    tolerance: NDArray[float64],
) -> PoseConstraint:
    """Return bounds of a link in the frame of another; -1: the model frame.

    Args:
        link: bounded link.
        frame: link whose frame the bounds are in.
        offset: (3,) point in the link's frame [m].
        regions: where the point may be; none: anywhere.
        region_poses: (N, 7) of the regions in the frame.
        orientation: 0: any, 1: Euler angles x-y-z, 2: rotation vector.
        target: (4,) frame_from_link, x y z w.
        tolerance: (3,) greatest angles [rad].
    """

def visibility_constraint(
    sensor_link: int,
    target_link: int,
    poses: NDArray[float64],
    view_axis: int,
    radius: float,
    sides: int,
    max_view_angle: float,
    max_range_angle: float,
) -> VisibilityConstraint:
    """Return a constraint of sight; `poses` (2, 7) are the sensor's and the target's in the frames of two links."""

def group_task(
    dimensions: NDArray[float64],
    variables: Sequence[int],
    reference: NDArray[float64],
    links: NDArray[bool_],
    poses: Sequence[PoseConstraint],
    visibilities: Sequence[VisibilityConstraint],
    segment_fraction: float,
    sweep: float,
    avoids_collisions: bool,
) -> GroupTask:
    """Return the task of a group.

    Args:
        dimensions: (n, 4) lower, upper, 1 if it turns without end, 1 if it is the first of a quaternion.
        variables: indices of the group's variables in a state.
        reference: state of all variables.
        links: mask of the links that move with the group; empty: all.
        poses: path constraints.
        visibilities: path constraints.
        segment_fraction: greatest step between checked states, as a fraction of the space's extent.
        sweep: motion of a link's points up to which nothing between two states is looked at [m].
        avoids_collisions: False: nothing collides.
    """

def goal(
    joints: NDArray[float64], poses: Sequence[PoseConstraint], visibilities: Sequence[VisibilityConstraint]
) -> Goal:
    """Return a goal; `joints` (N, 4) are rows of a variable of the group, lower bound, position, upper bound."""

def find_path(
    world: CollisionWorld,
    task: GroupTask,
    start: NDArray[float64],
    goals: Sequence[Goal],
    algorithm: int,
    range: float,
    goal_bias: float,
    max_iterations: int,
    max_goals: int,
    simplifies: bool,
    seed: int,
    seconds: float,
    cancel: CancelFlag,
) -> QueryResult:
    """Search a path from a valid start (n,); `algorithm`: 0 RRTConnect, 1 RRT, 2 RRTstar, 3 PRM, 4 PRMstar."""

def first_invalid(world: CollisionWorld, task: GroupTask, states: NDArray[float64]) -> int:
    """Return the first part of a path (N, n) that is not valid; -1: none."""

def fault_of(world: CollisionWorld, task: GroupTask, state: NDArray[float64]) -> int:
    """Return 0 for a valid state (n,), 1 beyond limits, 2 against the path constraints, 3 in collision."""

def satisfies(world: CollisionWorld, task: GroupTask, goal: Goal, state: NDArray[float64]) -> bool:
    """Return True if a state (n,) is in a goal."""

def valid_near(
    world: CollisionWorld, task: GroupTask, state: NDArray[float64], radius: float, attempts: int, seed: int
) -> NDArray[float64] | None:
    """Return a valid state (n,) whose variables are within a radius of others; None: none was found."""

def goal_states(
    world: CollisionWorld,
    task: GroupTask,
    start: NDArray[float64],
    goals: Sequence[Goal],
    count: int,
    attempts: int,
    seed: int,
) -> NDArray[float64]:
    """Return at most `count` valid states (N, n) that satisfy a goal."""

def follow_poses(
    world: CollisionWorld,
    task: GroupTask,
    start: NDArray[float64],
    link: int,
    offset: NDArray[float64],
    poses: NDArray[float64],
    is_prismatic: NDArray[bool_],
    revolute_jump: float,
    prismatic_jump: float,
) -> tuple[NDArray[float64], int]:
    """Move a link's frame through poses (N, 7) in the model frame, each from the state before.

    Return the states (M, n), and why it ends: 0 all are reached, 1 a pose is out of reach, 2 a state or the motion to
    it is not valid, 3 a variable jumps by more than its bound (0: any).
    """

_Timed = tuple[NDArray[float64], NDArray[float64], NDArray[float64], NDArray[float64]]

def time_optimal(
    waypoints: NDArray[float64],
    velocity: NDArray[float64],
    acceleration: NDArray[float64],
    tolerance: float,
    step_s: float,
) -> _Timed:
    """Return the fastest times (M,), positions, velocities and accelerations (M, n) along waypoints (N, n).

    Args:
        waypoints: their corners become arcs that leave them by at most the tolerance.
        velocity: (n,) limits, above zero.
        acceleration: (n,) limits, above zero.
        tolerance: [rad, m]
        step_s: time between states [s].
    """

def time_parabolic(waypoints: NDArray[float64], velocity: NDArray[float64], acceleration: NDArray[float64]) -> _Timed:
    """Return times (N,), positions, velocities and accelerations (N, n) of waypoints (N, n)."""
