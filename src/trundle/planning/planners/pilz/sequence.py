"""Motions after each other as one: with a stop between them, or blended around the corner."""

import numpy as np
from numpy.typing import NDArray

from trundle.planning import _planning
from trundle.planning.planning_scene import PlanningScene
from trundle.planning.trajectories import Trajectory, motion_limits

from ..cartesian_lines import tip_of
from ..error_codes import ErrorCode, RequestError
from ..group_problem import GroupProblem
from ..requests import Positions

_SAMPLING_S = 0.05
_SHORTEST_S = 1e-3
"""Least time between states where motions meet."""
_MIN_SAMPLES = 10
_DURATIONS = 9
"""Durations that are tried while a joint is too fast: from both motions at once to one after the other."""
_SLACK = 1.1
"""Factor of the radius in which a blended corner must be: joints are blended, not poses."""


def joined(scene: PlanningScene, group: str, first: Trajectory, second: Trajectory) -> Trajectory:
    """Return two trajectories (N, variables of the group) as one, with a stop between them."""
    second = _aligned(scene, group, first, second)
    return _concatenated(first, second, float(first.times[-1]), len(first.times), 1)


def blended(
    scene: PlanningScene, group: str, reference: Positions, first: Trajectory, second: Trajectory, radius: float
) -> Trajectory:
    """Return two trajectories (N, variables of the group) as one that does not stop between them.

    Inside the sphere of `radius` [m] around the corner of the group's tip, the joints go over from one motion to the
    other by the quintic 6s⁵ − 15s⁴ + 10s³, whose velocity and acceleration are zero at both ends, as in
    pilz_industrial_motion_planner's transition window. Pilz blends poses, which may leave a redundant arm with another
    elbow than the second motion has.

    Args:
        scene: scene of both.
        group: group of both, with one tip.
        reference: state of all variables; those of the group are replaced.
        first: motion up to the corner.
        second: motion from the corner.
        radius: greatest distance of the tip from the corner where the motions differ [m].

    Raises:
        RequestError: a motion does not leave the sphere, or the blended one is too fast or in collision.
    """
    second = _aligned(scene, group, first, second)
    problem = GroupProblem(scene, group, reference)
    link = tip_of(problem, None)
    corner = _places(problem, link, first.positions[-1:])[0]
    entered_s = first.duration - _leaving_time(problem, link, _reversed(first), corner, radius, "before")
    after_s = _leaving_time(problem, link, second, corner, radius, "after")
    before_s = first.duration - entered_s
    shortest = max(before_s, after_s)
    limits = motion_limits(problem.model, problem.variables).velocity
    middle = fastest = None
    for duration in np.linspace(shortest, before_s + after_s, _DURATIONS):
        middle = _transition(first, second, entered_s, after_s, float(duration))
        fastest = np.abs(middle.velocities).max(axis=0) / limits
        if fastest.max() <= 1.0:
            break
    assert middle is not None
    assert fastest is not None
    if fastest.max() > 1.0:
        name = problem.variables[int(fastest.argmax())]
        sentence = f"blend radius {radius:g} m: {name!r} would move at {fastest.max():.3g} times its limit"
        raise RequestError(ErrorCode.PLANNING_FAILED, f"{sentence}; a smaller velocity scaling helps")
    _check(problem, link, middle.positions, corner, radius)
    end = int(np.searchsorted(first.times, entered_s - _SHORTEST_S))
    begin = int(np.searchsorted(second.times, after_s + _SHORTEST_S))
    whole = _concatenated(first, middle, entered_s, end, 0)
    return _concatenated(whole, second, whole.duration - after_s, len(whole.times), begin)


def _transition(first: Trajectory, second: Trajectory, entered_s: float, after_s: float, duration: float) -> Trajectory:
    """Return the motion of `duration` [s] from one, which enters the sphere then, to the other, which leaves it."""
    times = np.linspace(0.0, duration, max(_MIN_SAMPLES, int(np.ceil(duration / _SAMPLING_S))) + 1)
    a, a_velocity = _at(first, entered_s + times)
    b, b_velocity = _at(second, times - (duration - after_s))
    s = (times / duration)[:, None]
    alpha, alpha_rate = s**3 * (10.0 - 15.0 * s + 6.0 * s**2), 30.0 * s**2 * (1.0 - s) ** 2 / duration
    velocities = a_velocity + alpha * (b_velocity - a_velocity) + alpha_rate * (b - a)
    return Trajectory(
        times=times,
        positions=a + alpha * (b - a),
        velocities=velocities,
        accelerations=np.gradient(velocities, times, axis=0),
    )


def _aligned(scene: PlanningScene, group: str, first: Trajectory, second: Trajectory) -> Trajectory:
    """Return the second trajectory with the turns of joints without end that the first one made."""
    joints = [scene.model.joint(name) for name in scene.model.group(group).joints]
    turns = np.array([float(joint.type == "continuous") for joint in joints for _ in joint.variables])
    whole_turns = np.rint((first.positions[-1] - second.positions[0]) / (2.0 * np.pi))
    shift = 2.0 * np.pi * whole_turns * turns
    return Trajectory(
        times=second.times,
        positions=second.positions + shift,
        velocities=second.velocities,
        accelerations=second.accelerations,
    )


def _concatenated(first: Trajectory, second: Trajectory, shift_s: float, end: int, begin: int) -> Trajectory:
    """Return the first `end` states of one trajectory and those from `begin` on of another that is later."""
    return Trajectory(
        times=np.concatenate([first.times[:end], second.times[begin:] + shift_s]),
        positions=np.vstack([first.positions[:end], second.positions[begin:]]),
        velocities=np.vstack([first.velocities[:end], second.velocities[begin:]]),
        accelerations=np.vstack([first.accelerations[:end], second.accelerations[begin:]]),
    )


def _places(problem: GroupProblem, link: str, values: Positions) -> NDArray[np.float64]:
    """Return the positions (N, 3) of a link in states of the group [m]."""
    return np.array([problem.scene.link_pose(link, state).position for state in problem.state_of(values)])


def _reversed(motion: Trajectory) -> Trajectory:
    """Return a motion backwards, for its places alone."""
    return Trajectory(
        times=motion.duration - motion.times[::-1],
        positions=motion.positions[::-1],
        velocities=motion.velocities[::-1],
        accelerations=motion.accelerations[::-1],
    )


def _leaving_time(
    problem: GroupProblem, link: str, motion: Trajectory, corner: NDArray[np.float64], radius: float, where: str
) -> float:
    """Return when a motion from the corner leaves the sphere [s]."""
    distances = np.linalg.norm(_places(problem, link, motion.positions) - corner, axis=1)
    outside = np.flatnonzero(distances > radius)
    if not len(outside) or outside[0] == 0:
        sentence = f"blend radius {radius:g} m: the motion {where} the corner does not leave the sphere"
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, sentence)
    leave = int(outside[0])
    share = (radius - distances[leave - 1]) / (distances[leave] - distances[leave - 1])
    return float(motion.times[leave - 1] + share * (motion.times[leave] - motion.times[leave - 1]))


def _at(motion: Trajectory, times: NDArray[np.float64]) -> tuple[Positions, Positions]:
    """Return positions and velocities at times, on straight lines between states; at rest before and after them."""
    columns = range(motion.positions.shape[1])
    positions = np.array([np.interp(times, motion.times, motion.positions[:, k]) for k in columns], dtype=np.float64)
    velocities = np.array([np.interp(times, motion.times, motion.velocities[:, k]) for k in columns], dtype=np.float64)
    return positions.T, velocities.T


def _check(problem: GroupProblem, link: str, positions: Positions, corner: NDArray[np.float64], radius: float) -> None:
    """Raise RequestError for a motion that leaves the sphere or is in collision."""
    if np.linalg.norm(_places(problem, link, positions) - corner, axis=1).max() > _SLACK * radius + 1e-3:
        sentence = f"blend radius {radius:g} m: the joints' blended motion leaves the sphere; a smaller radius helps"
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, sentence)
    path = np.ascontiguousarray(positions)
    if _planning.first_invalid(problem.scene.world, problem.task, path) >= 0:
        sentence = f"blend radius {radius:g} m: the motion around the corner is in collision"
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, sentence)
