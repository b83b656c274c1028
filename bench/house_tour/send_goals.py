"""Sends goals to move_base one after another, and writes what became of each."""

import json
import math
import os
import signal
from pathlib import Path
from typing import Any, Self

from trundle.gazebo.plugins import Plugin
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot


class SendGoals(Plugin):
    """Reads <goals>, a list of x, y, yaw; writes state, time and true track of each goal to <out>, as JSON."""

    period_ns = 50_000_000

    def __init__(self, model: ModelHandle, node: Node, goals: list[list[float]], out: Path) -> None:
        self._index = model.link("base_footprint").index
        self._goals = goals
        self._out = out
        self._rows: list[dict[str, Any]] = []
        self._is_driving = False
        self._time_s = 0.0
        self._publisher = node.advertise("/move_base/goal", "move_base_msgs/MoveBaseActionGoal", queue_size=1)
        self._is_ready = False
        node.subscribe("/move_base/status", "actionlib_msgs/GoalStatusArray", self._on_status, queue_size=1)
        node.subscribe("/move_base/result", "move_base_msgs/MoveBaseActionResult", self._on_result, queue_size=1)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Read the parameters."""
        assert node is not None, "the launch has a graph"
        parameters = TagParameters(tag.node, sim.report)
        return cls(model, node, json.loads(parameters.text("goals")), Path(parameters.text("out")))

    def _on_status(self, _message: Any) -> None:
        self._is_ready = True

    def _on_result(self, message: Any) -> None:
        row = self._rows[-1]
        row["state"], row["seconds"] = int(message.status.status), self._time_s - row.pop("begin")
        self._is_driving = False
        self._out.write_text(json.dumps(self._rows))
        if len(self._rows) == len(self._goals):
            os.kill(os.getpid(), signal.SIGINT)  # as Ctrl-C ends a launch

    def after_step(self, snapshot: Snapshot) -> None:
        """Note where the robot is; send the next goal once move_base has ended the last one."""
        self._time_s = snapshot.time_ns / 1e9
        x, y, _, w, _, _, z = snapshot.poses[self._index].tolist()
        place = [x, y, 2.0 * math.atan2(z, w)]
        if self._is_driving:
            self._rows[-1]["track"].append(place)
        elif self._is_ready and len(self._rows) < len(self._goals):
            goal = self._goals[len(self._rows)]
            self._rows.append({"goal": goal, "begin": self._time_s, "track": [place]})
            orientation = {"z": math.sin(goal[2] / 2.0), "w": math.cos(goal[2] / 2.0)}
            pose = {"position": {"x": goal[0], "y": goal[1]}, "orientation": orientation}
            target = {"header": {"frame_id": "map", "stamp": snapshot.time_ns}, "pose": pose}
            self._publisher.publish({"goal": {"target_pose": target}})
            self._is_driving = True
