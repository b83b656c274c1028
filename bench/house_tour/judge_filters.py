"""Drives through all rooms by the true pose, and notes how far amcl's filters are off."""

import ast
import json
import math
import os
import signal
from bisect import bisect
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, Self

from trundle.gazebo.plugins import Plugin
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node, Publisher, to_nsec
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot

_SPEED, _TURN = 0.22, 0.8
"""Greatest velocities [m/s, rad/s]."""
_SPACING_M = 0.9
"""Way between the starts of two filters."""
_OFFSET_M, _OFFSET_RAD = 0.5, math.radians(20)
_VARIANCES = {0: 0.25, 7: 0.25, 35: (math.pi / 12) ** 2}
"""Index in a guess's covariance → variance [m², rad²]."""


@dataclass(slots=True)
class _Filter:
    """One amcl, started on the way."""

    name: str
    """Namespace: /poseN or /globalN."""
    start_m: float
    begun_m: float | None = None
    errors: list[tuple[float, float, float]] = field(default_factory=list)
    """Way since its start [m], distance [m] and angle [deg] to the truth at each update."""


def _way(script: Path) -> list[tuple[float, float]]:
    """Return the points [m] of a script's list TOUR."""
    assignments = [line for line in ast.parse(script.read_text()).body if isinstance(line, ast.Assign)]
    return next(ast.literal_eval(line.value) for line in assignments if ast.unparse(line.targets[0]) == "TOUR")


class JudgeFilters(Plugin):
    """Reads <count> of filters of each kind and <tour>, a script with the way; writes <out>, as JSON, at its end.

    Filter N begins after N times the spacing: /poseN with a guess 0.5 m and 20° beside, /globalN with none.
    """

    period_ns = 50_000_000

    def __init__(self, model: ModelHandle, node: Node, way: list[tuple[float, float]], count: int, out: Path) -> None:
        self._index = model.link("base_footprint").index
        self._node = node
        self._way = way
        self._out = out
        self._is_turning = True
        self._times: list[int] = []
        self._places: list[tuple[float, float, float]] = []
        self._driven: list[float] = []
        self._commands = node.advertise("/cmd_vel", "geometry_msgs/Twist", queue_size=1)
        node.subscribe("/scan", "sensor_msgs/LaserScan", lambda _: None, queue_size=1)
        self._guesses: dict[str, Publisher] = {}
        self._filters: list[_Filter] = []
        kind = "geometry_msgs/PoseWithCovarianceStamped"
        for number in range(count):
            guessed, spread = (_Filter(f"/{name}{number}", 1.0 + _SPACING_M * number) for name in ("pose", "global"))
            self._guesses[guessed.name] = node.advertise(f"{guessed.name}/initialpose", kind, queue_size=1)
            for judged in (guessed, spread):
                self._filters.append(judged)
                node.subscribe(f"{judged.name}/amcl_pose", kind, partial(self._on_pose, judged), queue_size=9)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Read the parameters."""
        assert node is not None, "the launch has a graph"
        parameters = TagParameters(tag.node, sim.report)
        way = _way(Path(parameters.text("tour")))
        return cls(model, node, way, parameters.integer("count"), Path(parameters.text("out")))

    def after_step(self, snapshot: Snapshot) -> None:
        """Note where the robot is, start the filters that are due, drive on."""
        x, y, _, w, _, _, z = snapshot.poses[self._index].tolist()
        place = (x, y, 2.0 * math.atan2(z, w))
        way = self._driven[-1] + math.dist(self._places[-1][:2], place[:2]) if self._places else 0.0
        self._times.append(snapshot.time_ns)
        self._places.append(place)
        self._driven.append(way)
        for judged in self._filters:
            if judged.begun_m is None and way >= judged.start_m:
                judged.begun_m = way
                self._start(judged, snapshot.time_ns)
        self._drive(*place)

    def _start(self, judged: _Filter, stamp_ns: int) -> None:
        if judged.name not in self._guesses:
            self._node.loop.spawn(self._node.call_service(f"{judged.name}/global_localization", "std_srvs/Empty"))
            return
        (x, y, yaw), number = self._places[-1], list(self._guesses).index(judged.name)
        aside = number * math.tau / 10.0
        yaw += _OFFSET_RAD if number % 2 else -_OFFSET_RAD
        position = {"x": x + _OFFSET_M * math.cos(aside), "y": y + _OFFSET_M * math.sin(aside)}
        pose = {"position": position, "orientation": {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)}}
        covariance = [_VARIANCES.get(index, 0.0) for index in range(36)]
        header = {"frame_id": "map", "stamp": stamp_ns}
        self._guesses[judged.name].publish({"header": header, "pose": {"pose": pose, "covariance": covariance}})

    def _drive(self, x: float, y: float, yaw: float) -> None:
        """Turn toward the next point, then drive to it; end after the last one."""
        if math.dist(self._way[0], (x, y)) < 0.08:
            self._way.pop(0)
            self._is_turning = True
        if not self._way:
            rows = [{"name": judged.name, "errors": judged.errors} for judged in self._filters]
            self._out.write_text(json.dumps(rows))
            os.kill(os.getpid(), signal.SIGINT)  # as Ctrl-C ends a launch
            self._way = [(x + 1.0, y)]
        distance = math.dist(self._way[0], (x, y))
        ahead = math.remainder(math.atan2(self._way[0][1] - y, self._way[0][0] - x) - yaw, math.tau)
        self._is_turning = abs(ahead) > (0.1 if self._is_turning else 0.8)
        speed = 0.0 if self._is_turning else min(_SPEED, 0.08 + distance)
        turn = max(-_TURN, min(_TURN, (2.5 if self._is_turning else 2.0) * ahead))
        self._commands.publish({"linear": {"x": speed}, "angular": {"z": turn}})

    def _on_pose(self, judged: _Filter, message: Any) -> None:
        """Compare a pose with the truth at its stamp."""
        stamp_ns = to_nsec(message.header.stamp)
        later = min(max(1, bisect(self._times, stamp_ns)), len(self._times) - 1)
        if judged.begun_m is None or later < 1:
            return
        share = (stamp_ns - self._times[later - 1]) / (self._times[later] - self._times[later - 1])
        share = max(0.0, min(1.0, share))
        (x0, y0, yaw0), (x1, y1, yaw1) = self._places[later - 1], self._places[later]
        true = (x0 + share * (x1 - x0), y0 + share * (y1 - y0))
        true_yaw = yaw0 + share * math.remainder(yaw1 - yaw0, math.tau)
        way = self._driven[later - 1] + share * (self._driven[later] - self._driven[later - 1]) - judged.begun_m
        position, q = message.pose.pose.position, message.pose.pose.orientation
        off_m = math.dist(true, (position.x, position.y))
        off_deg = abs(math.degrees(math.remainder(2.0 * math.atan2(q.z, q.w) - true_yaw, math.tau)))
        if way >= 0.0:
            judged.errors.append((way, off_m, off_deg))
