"""Timed bands on different sides of obstacles, and the best of them."""

import math

import numpy as np
from numpy.typing import NDArray

from ...costmap import Costmap
from ..followed_plan import lengths_along
from ..interfaces import Pose2D
from ._bands import BandSettings, RobotBody, TimedBand
from .homotopy import Signature, islands_near, path_around, signature
from .teb_settings import TebSettings

Velocity = tuple[float, float, float]


class Candidate:
    """A band of one homotopy class."""

    def __init__(self, band: TimedBand) -> None:
        self.band = band
        self.cost = math.inf


class Candidates:
    """Bands between the robot and the end of its plan; each cycle goes on with those of the last one."""

    def __init__(self, settings: TebSettings) -> None:
        self._settings = settings
        self.bands: list[Candidate] = []
        """In no order."""
        self.best: Candidate | None = None
        """The selected one."""
        self._switched_s = -math.inf

    def clear(self) -> None:
        """Forget the bands."""
        self.bands, self.best = [], None

    def optimize(
        self,
        grid: Costmap,
        plan: NDArray[np.float64],
        settings: BandSettings,
        body: RobotBody,
        *,
        obstacles: NDArray[np.float64],
        via_points: NDArray[np.float64],
        velocity: Velocity,
        time_s: float,
    ) -> Candidate | None:
        """Find the bands again, optimize them, and select one; None if none has a finite cost.

        Args:
            grid: local costmap.
            plan: (n, 3) poses from the robot to the end of the visible plan, at least two.
            settings: of the optimization.
            body: the robot.
            obstacles: (n, 2) [m].
            via_points: (n, 2) [m].
            velocity: of the robot.
            time_s: time now.
        """
        own = self._settings
        start, goal = Pose2D(*plan[0].tolist()), Pose2D(*plan[-1].tolist())
        self._move(start, goal)
        first = self._band(plan, settings)
        if own.enable_homotopy_class_planning and own.max_number_classes > 1:
            islands = islands_near(grid, plan)
            preferred = signature(plan, islands)
            classes = self._by_class(islands)
            if preferred not in classes:
                classes[preferred] = first
            self._explore(grid, classes, islands, settings, goal)
        else:
            preferred = ()
            classes = {preferred: self.best or first}
        self.bands = list(classes.values())
        for kind, candidate in classes.items():
            candidate.cost = math.inf
            if own.optimization_activate:
                candidate.cost = candidate.band.optimize(
                    settings,
                    body,
                    obstacles,
                    via_points,
                    velocity=velocity,
                    obstacle_scale=own.selection_obst_cost_scale,
                )
            else:
                candidate.cost = float(candidate.band.steps.sum())
            if kind == preferred:
                candidate.cost *= own.selection_prefer_initial_plan
        self._select(time_s)
        return self.best

    def _move(self, start: Pose2D, goal: Pose2D) -> None:
        """Move the bands' ends; a band whose goal is elsewhere now begins anew."""
        settings = self._settings
        for candidate in list(self.bands):
            end = candidate.band.poses[-1]
            turn = abs(math.remainder(goal.yaw - end[2], 2.0 * math.pi))
            distance = math.hypot(goal.x - end[0], goal.y - end[1])
            if distance > settings.force_reinit_new_goal_dist or turn > settings.force_reinit_new_goal_angular:
                self.bands.remove(candidate)
                self.best = None if self.best is candidate else self.best
            else:
                candidate.band.move_ends(start, goal)

    def _by_class(self, islands: NDArray[np.float64]) -> dict[Signature, Candidate]:
        """Return the bands by their classes; of two in one class, the selected or else the first one."""
        classes: dict[Signature, Candidate] = {}
        for candidate in sorted(self.bands, key=lambda candidate: candidate is not self.best):
            classes.setdefault(signature(candidate.band.poses, islands), candidate)
        return dict(list(classes.items())[: self._settings.max_number_classes])

    def _explore(
        self,
        grid: Costmap,
        classes: dict[Signature, Candidate],
        islands: NDArray[np.float64],
        settings: BandSettings,
        goal: Pose2D,
    ) -> None:
        """Add bands that pass islands on the other side of the selected one."""
        base = self.best.band.poses if self.best is not None else next(iter(classes.values())).band.poses
        own = signature(base, islands)
        for number, island in enumerate(islands):
            if len(classes) >= self._settings.max_number_classes:
                return
            if any(kind[number] != own[number] for kind in classes):
                continue
            path = path_around(grid, base, island)
            if path is None:
                continue
            poses = np.column_stack([path, np.zeros(len(path))])
            poses[0], poses[-1] = base[0], (goal.x, goal.y, goal.yaw)
            poses[1:-1, 2] = headings(poses)[1:-1]
            classes.setdefault(signature(poses, islands), self._band(poses, settings))

    def _band(self, path: NDArray[np.float64], settings: BandSettings) -> Candidate:
        """Make a band of a path, with poses as far apart as the robot moves in `dt_ref`."""
        spacing = max(self._settings.max_vel_x * self._settings.dt_ref, 0.02)
        along = lengths_along(path)
        count = max(math.ceil(float(along[-1]) / spacing), 1) + 1
        chosen: NDArray[np.int64] = np.unique(np.searchsorted(along, np.linspace(0.0, float(along[-1]), count)))
        poses = path[np.append(chosen[chosen < len(path) - 1], len(path) - 1)]
        if len(poses) < 2:
            poses = path[[0, -1]]
        band = TimedBand()
        band.set_path(np.ascontiguousarray(poses), settings)
        return Candidate(band)

    def _select(self, time_s: float) -> None:
        settings = self._settings
        found = min(self.bands, key=lambda candidate: candidate.cost)
        if not math.isfinite(found.cost):
            self.clear()
            return
        last = self.best if self.best in self.bands else None
        if last is not None and found is not last:
            is_better = found.cost < settings.selection_cost_hysteresis * last.cost
            if not is_better or time_s - self._switched_s < settings.switching_blocking_period:
                return
        if found is not last:
            self._switched_s = time_s
        self.best = found


def headings(path: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the direction of a path (n, 2 or more) at each point [rad]; the last one's is that of the one before."""
    steps = np.diff(path[:, :2], axis=0)
    angles = np.arctan2(steps[:, 1], steps[:, 0])
    return np.append(angles, angles[-1:])
