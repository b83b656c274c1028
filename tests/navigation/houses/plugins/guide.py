"""Leads a robot along a way while it is mapped, or sends it to goals on the map, and writes what became of it."""

import itertools
import json
import math
import os
import signal
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.plugins import Plugin
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node, TransformError, TransformListener
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot

Pose = tuple[float, float, float]
_LOOKAHEAD_M = 0.5
_LEVEL = 0.7
"""Vertical part of a contact's normal below which it is a collision."""
_BEGIN_NS, _SETTLE_NS = 2_000_000_000, 4_000_000_000
_GUESS_ERROR = (0.3, -0.2, 0.25)
"""Error of the initial pose: x, y [m], yaw [rad]."""


class Guide(Plugin):
    """Reads <job>: JSON with `limit_s`, `out`, `map`, and `way`, `speed`, `turning_m`, or `goals` and `world_from_map`.

    Ways, goals, and the poses that it writes are in the world. While it maps, it notes `world_from_map`.
    """

    period_ns = 50_000_000

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, job: dict[str, Any]) -> None:
        self._sim, self._job = sim, job
        self._name, self._index = model.name, model.link("base_footprint").index
        self._result: dict[str, Any] = {"contacts": [], "goals": [], "track": []}
        self._begun = self._is_driving = self._is_over = False
        self._since_ns = 0
        self._buffer = TransformListener(node).buffer
        if "way" in job:
            self._way = _dense(job["way"])
            self._place = 0
            self._commands = node.advertise("/cmd_vel", "geometry_msgs/Twist", queue_size=1)
            node.subscribe("/map", "nav_msgs/OccupancyGrid", self._on_map, queue_size=1)
        else:
            self._guesses = node.advertise("/initialpose", "geometry_msgs/PoseWithCovarianceStamped", queue_size=1)
            self._targets = node.advertise("/move_base/goal", "move_base_msgs/MoveBaseActionGoal", queue_size=1)
            node.subscribe("/move_base/result", "move_base_msgs/MoveBaseActionResult", self._on_result, queue_size=1)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Read the job."""
        assert node is not None, "the launch has a graph"
        return cls(sim, model, node, json.loads(Path(TagParameters(tag.node, sim.report).text("job")).read_text()))

    def after_step(self, snapshot: Snapshot) -> None:
        """Watch the robot, and command it."""
        if self._is_over:
            return
        x, y, _, w, _, _, z = snapshot.poses[self._index].tolist()
        self._pose: Pose = (x, y, 2.0 * math.atan2(z, w))
        self._watch_contacts()
        self._now_ns = snapshot.time_ns
        self._result["track"].append(self._pose)
        if "way" in self._job:
            self._lead()
        else:
            self._send()
        if self._now_ns > self._job["limit_s"] * 1e9:
            self._end()

    def _watch_contacts(self) -> None:
        contacts = self._sim.contacts()
        for pair, normal in zip(contacts.collisions, contacts.normals, strict=True):
            models = {name.partition("::")[0] for name in pair}
            if models == {self._name, "building"} and abs(float(normal[2])) < _LEVEL:
                self._result["contacts"].append([self._now_ns / 1e9, *pair])

    # -- while it is mapped

    def _lead(self) -> None:
        """Steer toward a point of the way ahead."""
        found, pose = self._in_map(), self._pose
        if "world_from_map" not in self._result and found is not None:
            self._result["world_from_map"] = compose(pose, relative((0.0, 0.0, 0.0), found))
        if self._now_ns < _BEGIN_NS:
            return
        ahead = self._way[self._place : self._place + 30]
        self._place += int(np.hypot(ahead[:, 0] - pose[0], ahead[:, 1] - pose[1]).argmin())
        index = min(self._place + round(_LOOKAHEAD_M / 0.05), len(self._way) - 1)
        target = self._way[index]
        angle = math.remainder(math.atan2(target[1] - pose[1], target[0] - pose[0]) - pose[2], math.tau)
        distance, speed, radius = math.dist(target, pose[:2]), self._job["speed"], self._job["turning_m"]
        if distance < 0.25 and index == len(self._way) - 1:
            self._commands.publish({})
            self._end()
        elif radius > 0.0:  # an arc through the target, or back in a curve until the target is ahead
            curvature = 2.0 * math.sin(angle) / distance
            forward = speed if abs(angle) < 1.2 else -0.6 * speed
            sharpest = 1.0 / radius
            turn = abs(forward) * min(max(curvature, -sharpest), sharpest)
            self._commands.publish({"linear": {"x": forward}, "angular": {"z": turn}})
        else:
            forward = speed * max(math.cos(angle), 0.0) if abs(angle) < 0.6 else 0.0
            self._commands.publish({"linear": {"x": forward}, "angular": {"z": min(max(2.0 * angle, -0.8), 0.8)}})

    def _on_map(self, message: Any) -> None:
        info = message.info
        cells = np.array(message.data, dtype=np.int8).reshape(info.height, info.width)
        pixels = np.full(cells.shape, 205, dtype=np.uint8)
        pixels[cells == 0], pixels[cells > 60] = 254, 0
        file = Path(self._job["map"])
        header = f"P5\n{info.width} {info.height}\n255\n".encode()
        file.with_suffix(".pgm").write_bytes(header + np.flipud(pixels).tobytes())
        at = info.origin.position
        file.write_text(
            f"image: {file.stem}.pgm\nresolution: {info.resolution:.6f}\norigin: [{at.x}, {at.y}, 0.0]\n"
            "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
        )

    # -- on the map

    def _send(self) -> None:
        """Say where the robot is, wrongly, then send it to goals."""
        header = {"frame_id": "map", "stamp": self._now_ns}
        world_from_map, pose = tuple(self._job["world_from_map"]), self._pose
        in_map = relative(pose, world_from_map)
        if not self._begun:
            if self._now_ns > _BEGIN_NS and self._guesses.has_subscribers and self._targets.has_subscribers:
                guess = tuple(value + error for value, error in zip(in_map, _GUESS_ERROR, strict=True))
                covariance = np.zeros((6, 6))
                covariance[[0, 1, 5], [0, 1, 5]] = 0.25, 0.25, 0.07
                estimate = {"pose": _pose_fields(guess), "covariance": covariance.reshape(-1)}
                self._guesses.publish({"header": header, "pose": estimate})
                self._begun, self._since_ns = True, self._now_ns
            return
        if (found := self._in_map()) is not None:
            self._result["error_m"] = math.dist(found[:2], in_map[:2])
        if not self._is_driving and self._now_ns - self._since_ns > _SETTLE_NS:
            count = len(self._result["goals"])
            if count == len(self._job["goals"]):
                self._end()
                return
            goal = tuple(self._job["goals"][count])
            self._result["goals"].append({"goal": goal, "begin_s": self._now_ns / 1e9})
            target = {"header": header, "pose": _pose_fields(relative(goal, world_from_map))}
            self._targets.publish({"goal": {"target_pose": target}})
            self._is_driving = True

    def _in_map(self) -> Pose | None:
        """Return where the robot is by tf."""
        try:
            found = self._buffer.lookup_transform("map", "base_footprint").pose
        except TransformError:
            return None
        return found.position[0], found.position[1], found.rpy[2]

    def _on_result(self, message: Any) -> None:
        goal = self._result["goals"][-1]
        goal["state"], goal["seconds"] = int(message.status.status), self._now_ns / 1e9 - goal.pop("begin_s")
        goal["beside_m"] = math.dist(goal["goal"][:2], self._pose[:2])
        self._is_driving = False

    def _end(self) -> None:
        self._is_over = True
        self._result["seconds"] = self._now_ns / 1e9
        Path(self._job["out"]).write_text(json.dumps(self._result))
        os.kill(os.getpid(), signal.SIGINT)  # as Ctrl-C ends a launch


def _dense(corners: list[list[float]]) -> NDArray[np.float64]:
    """Return points of a way at every 0.05 m (n, 2)."""
    points: list[NDArray[np.float64]] = []
    for one, other in itertools.pairwise(corners):
        count = max(math.ceil(math.dist(one, other) / 0.05), 1)
        points.append(np.linspace(one, other, count, endpoint=False))
    return np.vstack([*points, np.array(corners[-1:])])


def relative(pose: Pose, frame: Pose) -> Pose:
    """Return a pose in a frame."""
    dx, dy, c, s = pose[0] - frame[0], pose[1] - frame[1], math.cos(frame[2]), math.sin(frame[2])
    return c * dx + s * dy, c * dy - s * dx, math.remainder(pose[2] - frame[2], math.tau)


def compose(frame: Pose, pose: Pose) -> Pose:
    """Return where a pose in a frame is outside it."""
    (x, y, yaw), c, s = pose, math.cos(frame[2]), math.sin(frame[2])
    return frame[0] + c * x - s * y, frame[1] + s * x + c * y, math.remainder(frame[2] + yaw, math.tau)


def _pose_fields(pose: tuple[float, ...]) -> dict[str, Any]:
    x, y, yaw = pose
    return {"position": {"x": x, "y": y}, "orientation": {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)}}
