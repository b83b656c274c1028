"""Scripted actor motion: trajectories in sequence, each a spline through waypoints."""

import math
from bisect import bisect_right
from itertools import accumulate, pairwise

from trundle.robots.model import Actor, AnimationState, Trajectory
from trundle.spatial import Pose, Twist, Vector3, conjugate, normalized, quaternion_product, slerp

_PIECES, _MAX_PIECES = 32, 100_000
"""Straight segments per waypoint interval, and their maximum, for the length of a path."""


class ActorScript:
    """Pose and animation of one actor over time; empty without waypoints."""

    def __init__(self, actor: Actor) -> None:
        self._delay = max(actor.delay_start_s, 0.0)
        self._loop = actor.loop
        self._first = actor.trajectories[0].type if actor.trajectories else ""
        self._paths: list[tuple[float, _WaypointPath]] = []
        """Start time [s] and path of each trajectory."""
        self.length_s = 0.0
        for trajectory in actor.trajectories:
            if trajectory.waypoints:
                self._paths.append((self.length_s, _WaypointPath(trajectory)))
                self.length_s += max(trajectory.waypoints[-1].time_s, 0.0)

    def __bool__(self) -> bool:
        """True if the actor has waypoints."""
        return bool(self._paths)

    def pose_at(self, time_s: float) -> Pose:
        """Return the world pose at a time since the actor's start; the delay precedes each round."""
        since, path = self._path_at(time_s)
        return path.pose_at(since)

    def animation_state_at(self, time_s: float) -> AnimationState:
        """Return the animation state; without waypoints the first animation plays in a loop."""
        if not self._paths:
            return AnimationState(animation=self._first, time_s=max(time_s - self._delay, 0.0))
        since, path = self._path_at(time_s)
        return AnimationState(animation=path.type, time_s=since, distance_m=path.distance_at(since))

    def _path_at(self, time_s: float) -> "tuple[float, _WaypointPath]":
        """Return the time since the start of the current path [s], and the path."""
        round_s = self._delay + self.length_s
        if self._loop and round_s > 0.0:
            time_s = math.fmod(time_s, round_s)
        since = min(max(time_s - self._delay, 0.0), self.length_s)
        start_s, path = self._paths[max(bisect_right([start for start, _ in self._paths], since) - 1, 0)]
        return since - start_s, path

    def twist_at(self, time_s: float, dt: float) -> Twist:
        """Return the twist that leads to the pose dt [s] later; zero at the jump back to the start."""
        round_s = self._delay + self.length_s
        if self._loop and round_s > 0.0 and math.fmod(time_s, round_s) + dt >= round_s:
            return Twist()
        start, end = self.pose_at(time_s), self.pose_at(time_s + dt)
        (x0, y0, z0), (x1, y1, z1) = start.position, end.position
        w, x, y, z = quaternion_product(end.quaternion, conjugate(start.quaternion))
        if w < 0.0:
            w, x, y, z = -w, -x, -y, -z
        axis = normalized((x, y, z))
        rate = 2 * math.atan2(math.hypot(x, y, z), w) / dt
        spin = (0.0, 0.0, 0.0) if axis is None else (axis[0] * rate, axis[1] * rate, axis[2] * rate)
        return Twist(((x1 - x0) / dt, (y1 - y0) / dt, (z1 - z0) / dt), spin)


class _WaypointPath:
    """Trajectory with positions on a cardinal spline, as in Gazebo, and slerp of orientations, where Gazebo uses
    splines.
    """

    def __init__(self, trajectory: Trajectory) -> None:
        points = trajectory.waypoints
        self.type = trajectory.type
        self._distances: list[float] | None = None
        self._times = [point.time_s for point in points]
        self._orientations = [point.pose.quaternion for point in points]
        self._positions = [point.pose.position for point in points]
        self._slopes = _slopes(self._positions, (1.0 - trajectory.tension) / 2)

    def pose_at(self, time_s: float) -> Pose:
        """Return the pose; constant before the first waypoint and after the last."""
        i = bisect_right(self._times, time_s) - 1
        if i < 0:
            return Pose(self._positions[0], self._orientations[0])
        if i >= len(self._times) - 1:
            return Pose(self._positions[-1], self._orientations[-1])
        u = (time_s - self._times[i]) / (self._times[i + 1] - self._times[i])
        a, b = u * u * (3 - 2 * u), u * (1 - u) ** 2
        c = u * u * (u - 1)

        def along(axis: int) -> float:
            start, end = self._positions[i][axis], self._positions[i + 1][axis]
            return start + a * (end - start) + b * self._slopes[i][axis] + c * self._slopes[i + 1][axis]

        return Pose((along(0), along(1), along(2)), slerp(self._orientations[i], self._orientations[i + 1], u))

    def distance_at(self, time_s: float) -> float:
        """Return the path length up to a time [m], from straight segments."""
        first, last = self._times[0], self._times[-1]
        if not first < time_s or not first < last:
            return 0.0
        count = min(_PIECES * (len(self._times) - 1), _MAX_PIECES)
        if self._distances is None:
            positions = [self.pose_at(first + (last - first) * i / count).position for i in range(count + 1)]
            self._distances = [0.0, *accumulate(math.dist(a, b) for a, b in pairwise(positions))]
        offset = min((time_s - first) / (last - first), 1.0) * count
        i = min(int(offset), count - 1)
        return self._distances[i] + (offset - i) * (self._distances[i + 1] - self._distances[i])


def _slopes(positions: list[Vector3], scale: float) -> list[Vector3]:
    """Return the cardinal spline's tangents; a path that ends at its start is closed."""
    last = len(positions) - 1
    closed = last > 1 and positions[0] == positions[last]

    def slope(i: int) -> Vector3:
        before = positions[i - 1] if i > 0 else positions[last - 1] if closed else positions[0]
        after = positions[i + 1] if i < last else positions[1] if closed else positions[last]
        x, y, z = (scale * (b - a) for a, b in zip(before, after, strict=True))
        return (x, y, z)

    return [slope(i) for i in range(len(positions))]
