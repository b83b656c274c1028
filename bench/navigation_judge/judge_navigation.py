"""Drives a robot about while it maps, or sends it to goals on the map, and writes what became of it."""

import json
import math
import os
import signal
import time
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes.map_server.occupancy_grid import read_map
from trundle.gazebo.plugins import Plugin
from trundle.navigation import _grids
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node, TransformError, TransformListener
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import transform_points

_TURN_AT_M, _FREE_AT_M = 0.8, 1.1
"""Distances ahead at which the driver begins and ends to turn."""
_LEVEL = 0.7
"""Vertical part of a contact's normal below which it is a collision."""
_SETTLE_NS = 6_000_000_000
_GUESS_ERROR = (0.25, -0.15, 0.2)
"""Error of the initial pose: x, y [m], yaw [rad]."""
_FREE_M, _ROOM_M = 0.1, 0.35
"""Distances from the robot's outline: to occupied cells on the way, and from a goal to places that are not known."""
_GAP_M = 0.15
"""Half the side of the squares in which the share of free cells is counted."""
_PASSABLE, _KNOWN = 0.3, 0.5
"""Share of free cells above which the way leads through a place, and above which the place is known."""
_LETHAL, _INSCRIBED, _OCCUPIED = 254, 253, 50
_Pose = tuple[float, float, float]


def _compose(a: _Pose, b: _Pose) -> _Pose:
    cos, sin = math.cos(a[2]), math.sin(a[2])
    return a[0] + cos * b[0] - sin * b[1], a[1] + sin * b[0] + cos * b[1], math.remainder(a[2] + b[2], math.tau)


def _inverse(a: _Pose) -> _Pose:
    cos, sin = math.cos(a[2]), math.sin(a[2])
    return -cos * a[0] - sin * a[1], sin * a[0] - cos * a[1], -a[2]


def _planar(x: float, y: float, z: float, w: float) -> _Pose:
    return x, y, 2.0 * math.atan2(z, w)


def choose_goals(map_file: Path, start: _Pose, radius_m: float, max_m: float) -> list[_Pose]:
    """Return two goals: the farthest place within a length of way, and one half the way back.

    Both are for a robot that needs `radius_m`: it has room on the way, and more at the goals, where it turns and the
    map may lack walls. A place is known by its surroundings: maps of fine cells have unknown ones between the rays.
    """
    grid = read_map(map_file)
    size = grid.resolution_m
    reach = math.ceil((radius_m + _FREE_M) / size)
    is_occupied, is_free = grid.cells > _OCCUPIED, grid.cells == 0
    share = _share(is_free, math.ceil(_GAP_M / size))
    is_clear = ~_grown(is_occupied, reach)
    is_roomy = is_clear & ~_grown(share <= _KNOWN, math.ceil((radius_m + _ROOM_M) / size))
    begin: tuple[int, int] = (int((start[0] - grid.origin[0]) / size), int((start[1] - grid.origin[1]) / size))
    is_open = is_clear & (share > _PASSABLE)
    rows, columns = np.indices(is_open.shape)
    is_open[(rows - begin[1]) ** 2 + (columns - begin[0]) ** 2 <= reach**2] = True  # the robot stands there
    lengths = _grids.wave_front(np.where(is_open, np.float32(1.0), np.float32(-1.0)), [begin]) * size
    lengths[(lengths > max_m) | ~is_roomy | ~is_free] = -1.0
    goals: list[_Pose] = []
    for ratio in (1.0, 0.5):
        wanted = ratio * float(lengths.max())
        row, column = divmod(int(np.abs(lengths - wanted).argmin()), is_open.shape[1])
        x, y = (column + 0.5) * size + grid.origin[0], (row + 0.5) * size + grid.origin[1]
        goals.append((float(x), float(y), math.atan2(start[1] - y, start[0] - x)))
    return goals


def _grown(cells: NDArray[np.bool_], reach: int) -> NDArray[np.bool_]:
    """Return the cells within a distance of True ones."""
    grown: NDArray[np.uint8] = np.where(cells, _LETHAL, 0).astype(np.uint8)
    costs = [_LETHAL if square == 0 else _INSCRIBED for square in range(reach**2 + 1)]
    _grids.inflate(grown, (0, 0, cells.shape[1], cells.shape[0]), costs, inflate_unknown=True)
    return grown != 0


def _share(cells: NDArray[np.bool_], reach: int) -> NDArray[np.float64]:
    """Return the share of True among each cell's neighbors, a square of ±reach; beyond the grid is False."""
    sums = np.pad(cells, ((reach + 1, reach), (reach + 1, reach))).astype(np.float64).cumsum(0).cumsum(1)
    side = 2 * reach + 1
    return (sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side]) / side**2


class JudgeNavigation(Plugin):
    """Reads <job>, a JSON of the options of `bench.public_navigation`, and writes <out>, as JSON."""

    period_ns = 20_000_000

    def __init__(self, sim: Simulation, node: Node, job: dict[str, Any], out: Path) -> None:
        self._sim, self._node, self._job, self._out = sim, node, job, out
        self._result: dict[str, Any] = {"collisions": [], "goals": [], "way_m": 0.0}
        self._buffer = TransformListener(node).buffer
        self._commands = node.advertise(job["cmd_vel"], "geometry_msgs/Twist", queue_size=1)
        self._guesses = node.advertise(job["initialpose"], "geometry_msgs/PoseWithCovarianceStamped", queue_size=1)
        self._goals = node.advertise(f"{job['move_base']}/goal", "move_base_msgs/MoveBaseActionGoal", queue_size=1)
        node.subscribe(job["scan"], "sensor_msgs/LaserScan", self._on_scan, queue_size=1)
        node.subscribe(f"{job['move_base']}/result", "move_base_msgs/MoveBaseActionResult", self._on_result)
        self._todo: list[_Pose] = []
        self._is_driving = self._is_turning = self._has_guessed = self._is_over = False
        self._turn = 1.0
        self._begin_ns: int | None = None
        self._begin_s = time.monotonic()
        self._now_ns = self._seen_ns = 0
        self._place: _Pose = (0.0, 0.0, 0.0)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Read the options."""
        del model
        assert node is not None, "the launch has a graph"
        parameters = TagParameters(tag.node, sim.report)
        return cls(sim, node, json.loads(Path(parameters.text("job")).read_text()), Path(parameters.text("out")))

    def after_step(self, snapshot: Snapshot) -> None:
        """Watch the robot; drive it, or send goals."""
        if self._is_over:
            return
        robot = next((model for model in self._sim.models if model.name == self._job["model"]), None)
        if robot is None:
            return
        self._now_ns = snapshot.time_ns
        names = [link.name for link in robot.links]
        base = robot.links[names.index(next(name for name in (self._job["link"], self._job["base"]) if name in names))]
        x, y, _, w, _, _, z = snapshot.poses[base.index].tolist()
        place = _planar(x, y, z, w)
        if self._begin_ns is not None:
            step = math.dist(place[:2], self._place[:2])
            self._result["way_m"] += step
            if self._is_driving:
                self._result["goals"][-1]["way_m"] += step
        self._place = place
        self._watch_contacts(robot.name)
        found = self._in_map()
        if found is not None and self._begin_ns is None:
            self._begin_ns = self._now_ns
            if self._job["map"] is None:
                self._result["world_from_map"] = _compose(place, _inverse(found))
        if self._begin_ns is None or self._job["map"] is None:
            if self._now_ns > self._job["limit_s"] * 1e9:
                self._end()
            if self._job["map"] is None:
                if found is not None:
                    self._compare(found, _compose(_inverse(self._result["world_from_map"]), place))
                return
        self._navigate(found)

    def _watch_contacts(self, robot: str) -> None:
        contacts = self._sim.contacts()
        for (one, other), normal in zip(contacts.collisions, contacts.normals, strict=True):
            models = (one.partition("::")[0], other.partition("::")[0])
            if robot in models and models[0] != models[1] and abs(float(normal[2])) < _LEVEL:
                with_ = other if models[0] == robot else one
                if with_ not in self._result["collisions"]:
                    self._result["collisions"].append(with_)

    def _in_map(self) -> _Pose | None:
        try:
            pose = self._buffer.lookup_transform(self._job["map_frame"], self._job["base"]).pose
        except TransformError:
            return None
        (x, y, _), (w, _, _, z) = pose.position, pose.quaternion
        return _planar(x, y, z, w)

    # -- while it maps

    def _on_scan(self, message: Any) -> None:
        """Drive forward; before an obstacle, turn toward the freer side."""
        if self._job["map"] is not None or self._is_over:
            return
        try:
            base_from_laser = self._buffer.lookup_transform(self._job["base"], message.header.frame_id).pose
        except TransformError:
            return
        ranges = np.asarray(message.ranges, dtype=float)
        angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
        ranges = np.where(np.isfinite(ranges) & (ranges >= message.range_min), ranges, 30.0)
        ends = np.stack([ranges * np.cos(angles), ranges * np.sin(angles), np.zeros(len(ranges))], axis=1)
        ahead, aside, _ = transform_points(base_from_laser, ends).T
        bearings = np.arctan2(aside, ahead)
        is_ahead = (ahead > 0.0) & (np.abs(aside) < self._job["radius"] + 0.15)
        free = float(ahead[is_ahead].min(initial=30.0)) - self._job["radius"]
        if not self._is_turning and free < _TURN_AT_M:
            self._is_turning = True
            self._turn = 1.0 if ranges[bearings > 0.2].mean() >= ranges[bearings < -0.2].mean() else -1.0
        elif self._is_turning and free > _FREE_AT_M:
            self._is_turning = False
        job = self._job
        forward, turn = (job["creep"], 0.7) if self._is_turning else (job["speed"], job["bend"])
        self._commands.publish({"linear": {"x": forward}, "angular": {"z": turn * self._turn}})

    # -- on the map

    def _navigate(self, found: _Pose | None) -> None:
        job = self._job
        in_map = _compose(_inverse(tuple(job["world_from_map"])), self._place)
        if not self._has_guessed:
            if not self._guesses.has_subscribers and job["localized"]:
                return
            x, y, yaw = (value + error for value, error in zip(in_map, _GUESS_ERROR, strict=True))
            covariance = [0.0] * 36
            covariance[0] = covariance[7] = 0.25
            covariance[35] = 0.07
            orientation = {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)}
            pose = {"pose": {"position": {"x": x, "y": y}, "orientation": orientation}, "covariance": covariance}
            self._guesses.publish({"header": {"frame_id": job["map_frame"], "stamp": self._now_ns}, "pose": pose})
            self._todo = choose_goals(Path(job["map"]), in_map, job["radius"], job["max_way"])
            self._has_guessed, self._seen_ns = True, self._now_ns
            return
        if found is not None:
            self._compare(found, in_map)
        is_settled = self._now_ns - self._seen_ns > _SETTLE_NS
        if not self._is_driving and is_settled and self._goals.has_subscribers:
            if not self._todo:
                self._end()
                return
            x, y, yaw = self._todo.pop(0)
            self._result["goals"].append(
                {"goal": [x, y], "begin": self._now_ns / 1e9, "from": in_map[:2], "way_m": 0.0}
            )
            orientation = {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)}
            pose = {"position": {"x": x, "y": y}, "orientation": orientation}
            header = {"frame_id": job["map_frame"], "stamp": self._now_ns}
            self._goals.publish({"goal": {"target_pose": {"header": header, "pose": pose}}})
            self._is_driving = True
        if self._now_ns > job["limit_s"] * 1e9:
            self._end()

    def _compare(self, found: _Pose, true: _Pose) -> None:
        """Note how far a pose in the map is from the true one."""
        error = math.dist(found[:2], true[:2])
        self._result.setdefault("first_error_m", error)
        if self._now_ns % 1_000_000_000 < self.period_ns and "LOGS" in os.environ:
            self._result.setdefault("trace", []).append([self._now_ns // 10**9, *true, *found])
        self._result["error_m"] = error
        self._result["error_deg"] = abs(math.degrees(math.remainder(found[2] - true[2], math.tau)))

    def _on_result(self, message: Any) -> None:
        if self._result["goals"] and self._is_driving:
            goal = self._result["goals"][-1]
            at = _compose(_inverse(tuple(self._job["world_from_map"])), self._place)
            goal["state"], goal["seconds"] = int(message.status.status), self._now_ns / 1e9 - goal["begin"]
            goal["beside_m"] = math.dist(at[:2], goal["goal"])
            self._is_driving = False
            self._seen_ns = self._now_ns - _SETTLE_NS

    def _end(self) -> None:
        self._is_over = True
        self._result |= {"seconds": self._now_ns / 1e9, "wall_s": time.monotonic() - self._begin_s}
        self._out.write_text(json.dumps(self._result))
        os.kill(os.getpid(), signal.SIGINT)  # as Ctrl-C ends a launch
