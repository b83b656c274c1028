"""The layers that a costmap's parameters name, in Hydro's form and in that from before."""

from typing import TYPE_CHECKING

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformBuffer

from ..settings import read_settings
from .costmap import Costmap
from .inflation_layer import InflationLayer, InflationSettings
from .observations import ObservationSource, SourceSettings
from .obstacle_layer import ObstacleLayer, ObstacleSettings
from .static_layer import StaticLayer, StaticSettings

if TYPE_CHECKING:
    from .layered_costmap import Layer

_OBSTACLES = frozenset({"ObstacleLayer", "VoxelLayer", "NonPersistentVoxelLayer"})


def plugin_list(node: Node, settings: RosParameters) -> list[tuple[str, str, RosParameters]]:
    """Return name, type and parameters of each layer; without `plugins`, as before Hydro."""
    if "plugins" in settings:
        listed = settings.sections("plugins")
        names = [(section.text("name"), section.text("type")) for section in listed]
        return [(name, kind, settings.section(name)) for name, kind in names]
    node.log.warn(f'{settings.namespace}: Parameter "plugins" not provided, loading pre-Hydro parameters')
    has_map = settings.flag("static_map", default=False)
    kind = "VoxelLayer" if settings.text("map_type", "costmap") == "voxel" else "ObstacleLayer"
    names = [
        *([("static_layer", "costmap_2d::StaticLayer")] if has_map else []),
        ("obstacle_layer", f"costmap_2d::{kind}"),
        ("inflation_layer", "costmap_2d::InflationLayer"),
    ]
    # A layer's own namespace counts, too, as after the original has moved the parameters there.
    return [(name, kind, settings) for name, kind in names]


class LayerMaker:
    """Makes the layers of one costmap."""

    def __init__(
        self,
        node: Node,
        settings: RosParameters,
        root: RosParameters,
        master: Costmap,
        buffer: TransformBuffer,
        *,
        frame: str,
        is_rolling: bool,
    ) -> None:
        """Take what layers need.

        Args:
            node: node of the costmap.
            settings: parameters of the costmap.
            root: parameters of the node, which ranges of observations are searched in, too.
            master: the costmap.
            buffer: transforms.
            frame: frame of the costmap.
            is_rolling: True for a rolling window.
        """
        self._node = node
        self._settings = settings
        self._root = root
        self._master = master
        self._buffer = buffer
        self._frame = frame
        self._is_rolling = is_rolling

    def make(self, name: str, kind: str, settings: RosParameters) -> "Layer | None":
        """Make a layer; None, with an error in the log, for a type that there is no stand-in for."""
        node, master = self._node, self._master
        short = kind.removeprefix("costmap_2d::").rpartition("/")[2]
        own = self._settings.section(name)
        if short in _OBSTACLES:
            tracks = own.flag("track_unknown_space", default=self._settings.flag("track_unknown_space", default=False))
            return ObstacleLayer(
                node,
                name,
                master,
                read_settings(ObstacleSettings, own, settings),
                self._sources(settings if "observation_sources" in settings else own),
                is_rolling=self._is_rolling,
                tracks_unknown=tracks,
            )
        if short == "StaticLayer":
            static = read_settings(StaticSettings, own) if settings is not self._settings else _old_static(settings)
            return StaticLayer(node, name, master, static, is_rolling=self._is_rolling)
        if short == "InflationLayer":
            return InflationLayer(name, master, read_settings(InflationSettings, own, settings))
        known = "StaticLayer, ObstacleLayer, VoxelLayer, InflationLayer"
        node.log.error(
            f"{self._settings.namespace}: no layer {kind!r}; the costmap goes on without it; there are: {known}"
        )
        return None

    def _sources(self, settings: RosParameters) -> list[ObservationSource]:
        """Read the observation sources of a layer."""
        sources: list[ObservationSource] = []
        names = settings.text("observation_sources", "").split()
        self._node.log.info(f"    Subscribed to Topics: {' '.join(names)}")
        for name in names:
            section = settings.section(name)
            source = read_settings(SourceSettings, section)
            for field in ("obstacle_range", "raytrace_range"):
                if field not in section:
                    spaces = (settings, self._settings, self._root)
                    found = next((space for space in spaces if field in space), section)
                    setattr(source, field, found.number(field, getattr(source, field), minimum=0.0))
            source.topic = source.topic or name
            sources.append(ObservationSource(self._node, source, self._frame, self._buffer))
        return sources


def _old_static(settings: RosParameters) -> StaticSettings:
    """Read the parameters from before Hydro, and the layer's namespace that replaced them."""
    static = read_settings(StaticSettings, settings.section("static_layer"))
    for old, field in (("map_topic", "map_topic"), ("unknown_cost_value", "unknown_cost_value")):
        if old in settings:
            setattr(static, field, getattr(read_settings(StaticSettings, settings), field))
    return static
