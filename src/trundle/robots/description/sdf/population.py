"""Reader of <population>: copies of a model, placed by a pattern or at random.

Random numbers come from the seed and the population's name. The patterns are Gazebo's, two of which may surprise: a
region's corner is offset from its centre before rotation, and rows start at one edge and end one step before the other.
"""

import math
import random
from collections.abc import Callable
from typing import TypeAlias

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.spatial import Pose, Vector3, add

from .context import Context, RawPose, read_pose
from .kmeans import kmeans_centers
from .unplaced_model import UnplacedModel

_MOST = 1_000
"""Most models of one population."""
_NODES_OF_A_MODEL = 20
"""Elements that take as long as a model."""
_SAMPLES = 10_000
_SPACING = 0.1
"""Spacing of the samples for a uniform distribution [m]."""
_Places: TypeAlias = list[Vector3]


def read_population(
    node: XmlNode, read_model: Callable[[XmlNode, Context], UnplacedModel], context: Context
) -> list[UnplacedModel]:
    """Return the posed models of a <population>; none with a warning if it is invalid."""
    report = context.report
    name = node.attribute("name") or ""
    template = node.find("model")
    if template is None:
        report.warn(node.at, f"<population> {name!r} without <model>; it is left out")
        return []
    part = read_model(template, context)
    pose = read_pose(node, context).pose
    region = _Region(node, context)
    places = region.places(random.Random(f"{context.seed} {name}"))
    node.report_unread(report)
    context.budget.add_nodes(_NODES_OF_A_MODEL * len(places), node.at)
    if isinstance(places, str):
        report.warn(node.at, f"<population> {name!r}: {places}; it is left out")
        return []
    return [
        replace(
            part,
            model=replace(part.model, name=f"{part.model.name}_clone_{number}"),
            raw=RawPose(Pose(add(pose.position, add(region.corner, pose.transform_vector(place)))), at=node.at),
        )
        for number, place in enumerate(places)
    ]


class _Region:
    """Region and distribution of a population."""

    def __init__(self, node: XmlNode, context: Context) -> None:
        report = context.report
        box, cylinder, how = node.find("box"), node.find("cylinder"), node.find("distribution")
        one = (1.0, 1.0, 1.0)
        self.size = None if box is None else box.vector("size", default=one)
        self.round = None
        if cylinder is not None and box is None:
            numbers = (cylinder.number(tag, default=1.0) for tag in ("radius", "length"))
            self.round = (next(numbers), next(numbers))
        elif cylinder is not None:
            report.warn(cylinder.at, "<cylinder> in <population> beside <box>; it is ignored")
        self.count = node.integer("model_count", default=1)
        self.kind, self.rows, self.columns, self.step = "random", 1, 1, (0.5, 0.5, 0.0)
        if how is not None:
            self.kind = how.string("type") or self.kind
            self.rows = how.integer("rows", default=1)
            self.columns = how.integer("cols", default=1)
            self.step = how.vector("step", default=self.step)
        for each in (box, cylinder, how):
            if each is not None:
                each.report_unread(report)

    @property
    def corner(self) -> Vector3:
        """Corner of the region, relative to the population's pose and not rotated with it."""
        if self.kind == "grid":
            return (-self.step[0] * (self.columns - 1) / 2, -self.step[1] * (self.rows - 1) / 2, 0.0)
        if self.size is not None:
            return (-self.size[0] / 2, -self.size[1] / 2, -self.size[2] / 2)
        return (0.0, 0.0, 0.0)

    def places(self, chance: random.Random) -> _Places | str:
        """Return the positions, or the reason why there are none."""
        count = self.rows * self.columns if self.kind == "grid" else self.count
        if not (0 < count <= _MOST and self.rows > 0 and self.columns > 0):
            return f"{count} models; 1 to {_MOST} are possible"
        if self.kind == "grid":
            sx, sy, _ = self.step
            return [(sx * column, sy * row, 0.0) for row in range(self.rows) for column in range(self.columns)]
        extent = self.size or self.round
        if extent is None:
            return "no <box> or <cylinder>"
        if not all(math.isfinite(length) and length > 0.0 for length in extent):
            return "its <box> or <cylinder> has no volume"
        match self.kind:
            case "random":
                return [self._random_point(chance) for _ in range(count)]
            case "uniform":
                return kmeans_centers(self._samples(chance), count, chance)
            case "linear-x" | "linear-y" | "linear-z" if self.size is not None:
                return _row("xyz".index(self.kind[-1]), self.size, count)
            case _:
                return f"no distribution {self.kind!r} of a {'cylinder' if self.size is None else 'box'}"

    def _random_point(self, chance: random.Random) -> Vector3:
        if self.size is not None:
            return (chance.uniform(0, self.size[0]), chance.uniform(0, self.size[1]), chance.uniform(0, self.size[2]))
        assert self.round is not None
        radius, length = self.round
        angle, away = chance.uniform(0, math.tau), chance.uniform(0, radius)
        return (away * math.cos(angle), away * math.sin(angle), chance.uniform(0, length))

    def _samples(self, chance: random.Random) -> _Places:
        """Return points that fill the region; for a box a horizontal grid with random heights."""
        if self.size is None:
            return [self._random_point(chance) for _ in range(_SAMPLES)]
        width, depth, height = self.size
        spacing = max(_SPACING, math.sqrt(width * depth / _SAMPLES))
        return [
            (x * spacing, y * spacing, chance.uniform(0, height))
            for y in range(math.ceil(depth / spacing))
            for x in range(math.ceil(width / spacing))
        ]


def _row(axis: int, size: Vector3, count: int) -> _Places:
    places: _Places = []
    for number in range(count):
        place = [length / 2 for length in size]
        place[axis] = size[axis] * number / count
        places.append((place[0], place[1], place[2]))
    return places
