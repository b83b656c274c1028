"""Reader of <population>: copies of a model, placed by a pattern or at random.

Random numbers come from the seed and the population's name. The patterns are Gazebo's, with two oddities: a region's
corner is offset from its centre before rotation, and rows start at one edge and end one step before the other.
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

_MAX_MODELS = 1_000
"""Maximum number of models of a population."""
_NODES_OF_A_MODEL = 20
"""Elements that count for a model in the reading budget."""
_SAMPLES = 10_000
_SPACING = 0.1
"""Spacing of the samples for a uniform distribution [m]."""
_Positions: TypeAlias = list[Vector3]


def read_population(
    node: XmlNode, read_model: Callable[[XmlNode, Context], UnplacedModel], context: Context
) -> list[UnplacedModel]:
    """Return the models of a <population> with their poses; none, with a warning, if it is invalid."""
    report = context.report
    name = node.attribute("name") or ""
    model = node.find("model")
    if model is None:
        report.warn(node.at, f"<population> {name!r} without <model>; it is left out", "incomplete-element")
        return []
    part = read_model(model, context)
    pose = read_pose(node, context).pose
    region = _Region(node, context)
    positions = region.positions(random.Random(f"{context.seed} {name}"))
    node.report_unread(report)
    context.budget.add_nodes(_NODES_OF_A_MODEL * len(positions), node.at)
    if isinstance(positions, str):
        report.warn(node.at, f"<population> {name!r}: {positions}; it is left out", "out-of-range")
        return []
    return [
        replace(
            part,
            model=replace(part.model, name=f"{part.model.name}_clone_{number}"),
            raw=RawPose(Pose(add(pose.position, add(region.corner, pose.transform_vector(position)))), at=node.at),
        )
        for number, position in enumerate(positions)
    ]


class _Region:
    """Region and distribution of a population."""

    def __init__(self, node: XmlNode, context: Context) -> None:
        report = context.report
        box, cylinder, distribution = node.find("box"), node.find("cylinder"), node.find("distribution")
        unit_size = (1.0, 1.0, 1.0)
        self.size = None if box is None else box.vector("size", default=unit_size)
        self.round = None
        if cylinder is not None and box is None:
            numbers = (cylinder.number(tag, default=1.0) for tag in ("radius", "length"))
            self.round = (next(numbers), next(numbers))
        elif cylinder is not None:
            report.warn(cylinder.at, "<cylinder> in <population> beside <box>; it is ignored", "duplicate-element")
        self.count = node.integer("model_count", default=1)
        self.kind, self.rows, self.columns, self.step = "random", 1, 1, (0.5, 0.5, 0.0)
        if distribution is not None:
            self.kind = distribution.string("type") or self.kind
            self.rows = distribution.integer("rows", default=1)
            self.columns = distribution.integer("cols", default=1)
            self.step = distribution.vector("step", default=self.step)
        for element in (box, cylinder, distribution):
            if element is not None:
                element.report_unread(report)

    @property
    def corner(self) -> Vector3:
        """Corner of the region, relative to the population's pose and not rotated with it."""
        if self.kind == "grid":
            return (-self.step[0] * (self.columns - 1) / 2, -self.step[1] * (self.rows - 1) / 2, 0.0)
        if self.size is not None:
            return (-self.size[0] / 2, -self.size[1] / 2, -self.size[2] / 2)
        return (0.0, 0.0, 0.0)

    def positions(self, rng: random.Random) -> _Positions | str:
        """Return the positions, or an error message."""
        count = self.rows * self.columns if self.kind == "grid" else self.count
        if not (0 < count <= _MAX_MODELS and self.rows > 0 and self.columns > 0):
            return f"{count} models; 1 to {_MAX_MODELS} are possible"
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
                return [self._random_point(rng) for _ in range(count)]
            case "uniform":
                return kmeans_centers(self._samples(rng), count, rng)
            case "linear-x" | "linear-y" | "linear-z" if self.size is not None:
                return _row("xyz".index(self.kind[-1]), self.size, count)
            case _:
                return f"no distribution {self.kind!r} of a {'cylinder' if self.size is None else 'box'}"

    def _random_point(self, rng: random.Random) -> Vector3:
        if self.size is not None:
            return (
                rng.uniform(0, self.size[0]),
                rng.uniform(0, self.size[1]),
                rng.uniform(0, self.size[2]),
            )
        assert self.round is not None
        radius, length = self.round
        angle, distance = rng.uniform(0, math.tau), rng.uniform(0, radius)
        return (distance * math.cos(angle), distance * math.sin(angle), rng.uniform(0, length))

    def _samples(self, rng: random.Random) -> _Positions:
        """Return points that fill the region; in a box, a horizontal grid with random heights."""
        if self.size is None:
            return [self._random_point(rng) for _ in range(_SAMPLES)]
        width, depth, height = self.size
        spacing = max(_SPACING, math.sqrt(width * depth / _SAMPLES))
        return [
            (x * spacing, y * spacing, rng.uniform(0, height))
            for y in range(math.ceil(depth / spacing))
            for x in range(math.ceil(width / spacing))
        ]


def _row(axis: int, size: Vector3, count: int) -> _Positions:
    positions: _Positions = []
    for number in range(count):
        position = [length / 2 for length in size]
        position[axis] = size[axis] * number / count
        positions.append((position[0], position[1], position[2]))
    return positions
