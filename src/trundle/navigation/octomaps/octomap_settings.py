"""Parameters of octomap_server."""

import math
from typing import Annotated, NamedTuple

import msgspec
from msgspec import Meta

from trundle.base.built import refuse_stale
from trundle.robots.parameters import ParamError, RosParameters

from . import _octomaps

refuse_stale(_octomaps)
_Positive = Annotated[float, Meta(ge=0.0)]
_MAX = math.inf


class OctomapSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults; lengths [m], angles [rad]."""

    frame_id: str = "map"
    base_frame_id: str = "base_footprint"
    height_map: bool = True
    color_factor: float = 0.8
    resolution: Annotated[float, Meta(ge=0.001, le=100.0)] = 0.05
    pointcloud_min_x: float = -_MAX
    pointcloud_max_x: float = _MAX
    pointcloud_min_y: float = -_MAX
    pointcloud_max_y: float = _MAX
    pointcloud_min_z: float = -_MAX
    pointcloud_max_z: float = _MAX
    occupancy_min_z: float = -_MAX
    occupancy_max_z: float = _MAX
    min_x_size: _Positive = 0.0
    min_y_size: _Positive = 0.0
    filter_ground: bool = False
    publish_free_space: bool = False
    latch: bool = True


WITHOUT_EFFECT = ("compress_map", "incremental_2D_projection", "filter_speckles", "colored_map")
"""Parameters of the original that are read by nothing: maps are always compressed, whole, and without colors."""


class GroundFilter(NamedTuple):
    """Thresholds of the ground plane."""

    distance: float
    """Distance of its points from a plane [m]."""
    angle: float
    """Largest slope [rad]."""
    plane_distance: float
    """Largest distance of the plane from the robot's frame [m]."""


class Color(NamedTuple):
    """Red, green, blue and opacity [0, 1]."""

    r: float
    g: float
    b: float
    a: float

    @classmethod
    def read(cls, parameters: RosParameters, default: "Color") -> "Color":
        """Read parameters r, g, b and a."""
        return cls(*(parameters.number(name, value) for name, value in default._asdict().items()))


def read_tree(parameters: RosParameters, resolution: float) -> tuple[_octomaps.OccupancyTree, float]:
    """Return an empty tree by the parameters below `sensor_model`, and the greatest range [m], −1: none.

    Raises:
        ParamError: a probability is on the wrong side of one half.
    """
    model = parameters.section("sensor_model")
    hit, miss = model.number("hit", 0.7), model.number("miss", 0.4)
    low, high = model.number("min", 0.12), model.number("max", 0.97)
    if not (0.0 < miss < 0.5 < hit < 1.0 and 0.0 < low < 0.5 < high < 1.0):
        raise ParamError(
            f"{model.namespace}: expected 0 < miss, min < 0.5 < hit, max < 1; they are miss {miss:g}, min {low:g}, "
            f"hit {hit:g}, max {high:g}"
        )
    tree = _octomaps.OccupancyTree(resolution, hit=_odds(hit), miss=_odds(miss), lower=_odds(low), upper=_odds(high))
    return tree, model.number("max_range", -1.0)


def read_ground_filter(parameters: RosParameters) -> GroundFilter:
    """Read the parameters below `ground_filter`."""
    section = parameters.section("ground_filter")
    return GroundFilter(
        section.number("distance", 0.04), section.number("angle", 0.15), section.number("plane_distance", 0.07)
    )


def _odds(probability: float) -> float:
    return math.log(probability / (1.0 - probability))
