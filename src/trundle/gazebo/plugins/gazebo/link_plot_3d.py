"""libLinkPlot3DPlugin.so: paths of links, as lines."""

import math
from dataclasses import dataclass
from typing import Self

from trundle.base.diagnostics import UsageError
from trundle.robots.description import GAZEBO_MATERIALS
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import DebugLine, LinkHandle, ModelHandle, Simulation
from trundle.spatial import Pose, Vector3

from ..plugin import Plugin

_MIN_DISTANCE = 0.05
"""Minimum distance between two points [m]."""
_MAX_POINTS, _DROPPED_POINTS = 1000, 5
"""Largest number of points of a line, and number of the oldest that are dropped beyond it."""


@dataclass(frozen=True, slots=True, eq=False)
class _Plot:
    link: LinkHandle
    link_from_pen: Pose
    line: DebugLine


class LinkPlot3D(Plugin):
    """Draws the paths of links: on the page, by `Simulation.lines`, and as visualization_msgs/Marker on /marker.

    Parameters: <frequency> [Hz] (30) and any number of <plot>: <link>, <pose> in the link's frame, <material>
    (Gazebo/Black). A point is kept every 5 cm, the newest 1000 of them.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        frequency = parameters.number("frequency", 30.0)
        self.period_ns = round(1e9 / frequency) if frequency > 0.0 else 0
        self._plots: list[_Plot] = []
        for plot in parameters.sections("plot"):
            pen = Pose.from_rpy(*plot.numbers("pose", 6, (0.0,) * 6))
            name = plot.text("material", "Gazebo/Black")
            material = GAZEBO_MATERIALS.get(name)
            if material is None:
                plot.warn(f"Gazebo has no material {name!r}; the line is black")
            try:
                link = model.link(plot.text("link"))
            except UsageError as error:
                plot.warn(f"<plot>: {error}; it is left out")
                continue
            line = DebugLine((0.0, 0.0, 0.0) if material is None else material.diffuse[:3])
            sim.lines[f"{model.name}::plot_{link.name}_{len(self._plots)}"] = line
            self._plots.append(_Plot(link, pen, line))
        parameters.report_unread()
        self._topic = None if node is None else node.advertise("/marker", "visualization_msgs/Marker", queue_size=10)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        return cls(sim, model, node, tag)

    def before_step(self, sim: Simulation) -> None:
        """Append the links' positions."""
        for number, plot in enumerate(self._plots):
            position = (plot.link.pose @ plot.link_from_pen).position
            points = plot.line.points
            if points and math.dist(position, points[-1]) <= _MIN_DISTANCE:
                continue
            points.append(position)
            if len(points) > _MAX_POINTS:
                del points[:_DROPPED_POINTS]
            self._publish(number, plot, sim.time_ns)

    def reset(self) -> None:
        """Clear the lines."""
        for plot in self._plots:
            plot.line.points.clear()

    def _publish(self, number: int, plot: _Plot, time_ns: int) -> None:
        if self._topic is None or not self._topic.has_subscribers:
            return
        red, green, blue = plot.line.rgb
        self._topic.publish(
            {
                "header": {"stamp": time_ns, "frame_id": "world"},
                "ns": f"plot_{plot.link.name}",
                "id": number,
                "type": 4,  # LINE_STRIP
                "pose": {"orientation": {"w": 1.0}},
                "scale": {"x": 0.01},
                "color": {"r": red, "g": green, "b": blue, "a": 1.0},
                "points": [_point(point) for point in plot.line.points],
            }
        )


def _point(point: Vector3) -> dict[str, float]:
    return {"x": point[0], "y": point[1], "z": point[2]}
