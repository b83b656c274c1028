"""cartographer_node's configuration in Lua, with the original's names and defaults."""

import math
import os
from pathlib import Path
from typing import Annotated

from msgspec import Meta, Struct

from trundle.base.diagnostics import UsageError
from trundle.base.files import read_text
from trundle.robots.parameters import ParamError, RosParameters

from ..settings import read_settings
from . import _mapping
from .lua import LuaError, LuaReader, LuaTable

_MAX_BYTES = 1_000_000
_MAX_FILES = 50
_BUILDER, _GRAPH, _OPTIONS = "TRAJECTORY_BUILDER_2D", "POSE_GRAPH", "options"
_OWN_FILES = frozenset(
    {
        "map_builder.lua",
        "map_builder_server.lua",
        "pose_graph.lua",
        "trajectory_builder.lua",
        "trajectory_builder_2d.lua",
        "trajectory_builder_3d.lua",
    }
)
"""Files of the original's installation: their tables, with its defaults, are built in."""
_LEAST_ANGLE = math.radians(5.0)
"""Between scans of the graph; the original's degree fills it with scans of one place while the robot turns."""
_ODOMETRY_NOISE, _MOTION_NOISE = (0.005, 0.003), (0.05, 0.05)
"""Deviations of a predicted motion [m], [rad]: by odometry, and by constant velocity."""
_Length = Annotated[float, Meta(ge=0.0, le=1e6)]
_Angle = Annotated[float, Meta(ge=0.0, le=math.pi)]
_Ratio = Annotated[float, Meta(ge=0.0, le=1.0)]
_Period = Annotated[float, Meta(ge=0.001, le=1e6)]
_Count = Annotated[int, Meta(ge=0, le=100_000)]


class CartographerSettings(Struct, frozen=True):
    """Lengths [m], angles [rad], times [s]."""

    map_frame: str = "map"
    tracking_frame: str = "base_link"
    published_frame: str = "base_link"
    odom_frame: str = "odom"
    provide_odom_frame: bool = True
    publish_to_tf: bool = True
    publish_tracked_pose: bool = False
    use_odometry: bool = False
    num_laser_scans: _Count = 0
    num_multi_echo_laser_scans: _Count = 0
    num_point_clouds: _Count = 0
    submap_publish_period_sec: _Period = 0.3
    pose_publish_period_sec: _Period = 0.005
    trajectory_publish_period_sec: _Period = 0.03
    use_imu_data: bool = True
    min_range: _Length = 0.0
    max_range: _Length = 30.0
    missing_data_ray_length: _Length = 5.0
    linear_search_window: Annotated[float, Meta(ge=0.0, le=20.0)] = 0.1
    angular_search_window: _Angle = math.radians(20.0)
    max_time_seconds: _Length = 5.0
    max_distance_meters: _Length = 0.2
    max_angle_radians: _Angle = math.radians(1.0)
    num_range_data: Annotated[int, Meta(ge=1, le=100_000)] = 90
    resolution: Annotated[float, Meta(ge=0.001, le=10.0)] = 0.05
    optimize_every_n_nodes: _Count = 90
    min_score: _Ratio = 0.55
    max_constraint_distance: _Length = 15.0
    loop_linear_search_window: Annotated[float, Meta(ge=0.0, le=20.0)] = 7.0
    loop_angular_search_window: _Angle = math.radians(30.0)

    def graph_options(self) -> _mapping.GraphOptions:
        """Return the options of the graph."""
        options = _mapping.GraphOptions()
        options.resolution = self.resolution
        options.least_distance, options.longest_time = self.max_distance_meters, self.max_time_seconds
        options.least_angle = max(self.max_angle_radians, _LEAST_ANGLE)
        options.matches_all = not self.use_odometry
        noise = _ODOMETRY_NOISE if self.use_odometry else _MOTION_NOISE
        options.still_linear_noise, options.still_angular_noise = noise
        options.running_scans = min(self.num_range_data, 90)
        options.closes_loops = self.optimize_every_n_nodes > 0
        options.loop_distance = min(self.max_constraint_distance, self.loop_linear_search_window)
        options.loop_response_coarse = options.link_response = options.loop_response_fine = self.min_score
        search, loop_search = _mapping.SearchOptions(), _mapping.SearchOptions()
        search.half_width, search.half_angle = self.linear_search_window, self.angular_search_window
        loop_search.half_width = self.loop_linear_search_window
        loop_search.half_angle, loop_search.angle_step = self.loop_angular_search_window, math.radians(1.0)
        loop_search.is_penalized = False
        options.search, options.loop_search = search, loop_search
        return options


_PATHS = {
    "use_imu_data": (_BUILDER, "use_imu_data"),
    "min_range": (_BUILDER, "min_range"),
    "max_range": (_BUILDER, "max_range"),
    "missing_data_ray_length": (_BUILDER, "missing_data_ray_length"),
    "linear_search_window": (_BUILDER, "real_time_correlative_scan_matcher", "linear_search_window"),
    "angular_search_window": (_BUILDER, "real_time_correlative_scan_matcher", "angular_search_window"),
    "max_time_seconds": (_BUILDER, "motion_filter", "max_time_seconds"),
    "max_distance_meters": (_BUILDER, "motion_filter", "max_distance_meters"),
    "max_angle_radians": (_BUILDER, "motion_filter", "max_angle_radians"),
    "num_range_data": (_BUILDER, "submaps", "num_range_data"),
    "resolution": (_BUILDER, "submaps", "grid_options_2d", "resolution"),
    "optimize_every_n_nodes": (_GRAPH, "optimize_every_n_nodes"),
    "min_score": (_GRAPH, "constraint_builder", "min_score"),
    "max_constraint_distance": (_GRAPH, "constraint_builder", "max_constraint_distance"),
    "loop_linear_search_window": (
        _GRAPH,
        "constraint_builder",
        "fast_correlative_scan_matcher",
        "linear_search_window",
    ),
    "loop_angular_search_window": (
        _GRAPH,
        "constraint_builder",
        "fast_correlative_scan_matcher",
        "angular_search_window",
    ),
}
"""Places of the settings in the configuration; others are options of the node."""


def read_configuration(folder: Path, name: str) -> tuple[CartographerSettings, str]:
    """Read a configuration; return it with a sentence on what was set in it without effect, empty if all has.

    Raises:
        UsageError: a file is missing or cannot be read, or an option is invalid.
    """
    reader = LuaReader(_Includes(folder))
    reader.values |= _tables()
    path = folder / name
    options = reader.run(_read(path), str(path))
    if not isinstance(options, dict):
        raise UsageError(f"{path}: it returns no table of options")
    if _get(reader.values, "MAP_BUILDER", "use_trajectory_builder_3d") is True:
        raise UsageError(f"{path}: MAP_BUILDER.use_trajectory_builder_3d: only 2D is built in")
    tree: dict[str, object] = {}
    for field in CartographerSettings.__struct_fields__:
        place = _PATHS.get(field)
        value = _get(options, field) if place is None else _get(reader.values, *place)
        if value is not None:
            tree[field] = value
    try:
        settings = read_settings(CartographerSettings, RosParameters(tree, f"{path}:"))
    except ParamError as error:
        raise UsageError(str(error).replace(f"parameter {path}:/", f"{path}: ")) from None
    used = {".".join(place) for place in _PATHS.values()} | {_OPTIONS, "MAP_BUILDER.use_trajectory_builder_2d"}
    used |= {f"{_OPTIONS}.{field}" for field in CartographerSettings.__struct_fields__}
    unused = sorted(set(reader.assigned) - used)
    return settings, f"options without effect here: {', '.join(unused)}" if unused else ""


def _tables() -> LuaTable:
    """Return the original's tables, as far as they are used, with its defaults."""
    defaults = CartographerSettings()
    values: LuaTable = {"MAP_BUILDER": {}, "TRAJECTORY_BUILDER": {}, "TRAJECTORY_BUILDER_3D": {}}
    for field, place in _PATHS.items():
        table = values
        for key in place[:-1]:
            inner = table.setdefault(key, {})
            assert isinstance(inner, dict), "only the last name is of a value"
            table = inner
        default = getattr(defaults, field)
        table[place[-1]] = default if isinstance(default, bool) else float(default)
    for name, inner in (("pose_graph", _GRAPH), ("trajectory_builder_2d", _BUILDER)):
        table = values["MAP_BUILDER" if inner == _GRAPH else "TRAJECTORY_BUILDER"]
        assert isinstance(table, dict), "made above"
        table[name] = values[inner]
    return values


def _get(values: LuaTable, *place: str) -> object:
    value: object = values
    for key in place:
        if not isinstance(value, dict):
            return None
        value = value.get(key)
    return value


def _read(path: Path) -> str:
    try:
        return read_text(path, max_bytes=_MAX_BYTES)
    except OSError as error:
        raise UsageError(f"{path}: {error.strerror}") from None


class _Includes:
    """Runs included files: those beside the configuration, else the original's own."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._open: list[str] = []
        self._count = 0

    def __call__(self, reader: LuaReader, name: str) -> None:
        path = self._folder / name
        if not os.path.exists(path) and name in _OWN_FILES:
            return
        self._count += 1
        if name in self._open or self._count > _MAX_FILES:
            raise LuaError(f"{path}: it includes itself, or there are more than {_MAX_FILES} includes")
        self._open.append(name)
        assigned = len(reader.assigned)
        reader.run(_read(path), str(path))
        if name in _OWN_FILES:
            del reader.assigned[assigned:]
        self._open.pop()
