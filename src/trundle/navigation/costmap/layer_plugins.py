"""The layers that a costmap's parameters name, in the form since Hydro or in the one before it."""

import re
from collections.abc import Callable
from typing import TYPE_CHECKING

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformBuffer

from ..plugin_classes import find_plugin_class
from ..settings import read_settings
from .bounded_explore_layer import BoundedExploreLayer, BoundedExploreSettings
from .costmap import Costmap
from .inflation_layer import InflationLayer, InflationSettings
from .observations import ObservationSource, SourceSettings
from .obstacle_layer import ObstacleLayer, ObstacleSettings
from .plugin import LayerPlugin
from .range_sensor_layer import RangeSensorLayer, RangeSettings
from .social_layer import SocialLayer, SocialSettings
from .static_layer import StaticLayer, StaticSettings
from .voxel_layer import NonPersistentVoxelLayer, VoxelLayer, VoxelSettings

if TYPE_CHECKING:
    from .layered_costmap import Layer
LAYER_GROUP = "trundle.navigation.layers"
"""Group of entry points of installed layers."""


def plugin_list(node: Node, settings: RosParameters) -> list[tuple[str, str, RosParameters]]:
    """Return name, type and parameters of each layer; without `plugins`, those from before Hydro."""
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
    # A layer's own namespace is read, too: the original moves the parameters into it.
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
            root: parameters of the node, where ranges of observations are searched after `settings`.
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
        """Make a layer; None, with an error in the log, for a type that there is not.

        Raises:
            ParamError: a user's class does not load.
        """
        short = re.split("::|/", kind)[-1]
        make = _MAKERS.get(short)
        if make is None:
            own = find_plugin_class(self._node, LAYER_GROUP, LayerPlugin, kind)
            if own is not None:
                section = self._settings.section(name)
                return own(self._node, name, section, self._master, self._buffer, self._frame)
            self._node.log.error(
                f"{self._settings.namespace}: no layer {kind!r}; the costmap goes on without it; "
                f"there are: {', '.join(_MAKERS)}"
            )
            return None
        if short == "SpatioTemporalVoxelLayer":
            self._node.log.warn(
                f"{self._settings.namespace}/{name}: a VoxelLayer replaces {kind}; rays clear its voxels, not time"
            )
        return make(self, name, settings)

    def make_static(self, name: str, settings: RosParameters) -> StaticLayer:
        own = self._settings.section(name)
        static = read_settings(StaticSettings, own) if settings is not self._settings else _old_static(settings)
        return StaticLayer(
            self._node,
            name,
            self._master,
            static,
            frame=self._frame,
            buffer=self._buffer,
            is_rolling=self._is_rolling,
        )

    def make_inflation(self, name: str, settings: RosParameters) -> InflationLayer:
        own = self._settings.section(name)
        return InflationLayer(name, self._master, read_settings(InflationSettings, own, settings))

    def make_obstacles(self, name: str, settings: RosParameters) -> ObstacleLayer:
        own = self._settings.section(name)
        return ObstacleLayer(
            self._node,
            name,
            self._master,
            read_settings(ObstacleSettings, own, settings),
            self._sources(name, settings),
            is_rolling=self._is_rolling,
            tracks_unknown=self._tracks_unknown(own),
        )

    def make_voxels(self, name: str, settings: RosParameters) -> VoxelLayer:
        return self._make_voxel_layer(VoxelLayer, name, settings)

    def make_forgetful_voxels(self, name: str, settings: RosParameters) -> VoxelLayer:
        return self._make_voxel_layer(NonPersistentVoxelLayer, name, settings)

    def _make_voxel_layer(self, layer: type[VoxelLayer], name: str, settings: RosParameters) -> VoxelLayer:
        own = self._settings.section(name)
        publishes = own.flag("publish_voxel_map", default=settings.flag("publish_voxel_map", default=False))
        return layer(
            self._node,
            name,
            self._master,
            read_settings(VoxelSettings, own, settings),
            self._sources(name, settings),
            is_rolling=self._is_rolling,
            tracks_unknown=self._tracks_unknown(own),
            frame=self._frame,
            topic=f"{own.namespace}/voxel_grid" if publishes else None,
        )

    def make_ranges(self, name: str, settings: RosParameters) -> RangeSensorLayer:
        del settings
        own = self._settings.section(name)
        return RangeSensorLayer(
            self._node,
            name,
            self._master,
            read_settings(RangeSettings, own),
            own.texts("topics") or ["/sonar"],
            kind=own.text("input_sensor_type", "ALL").upper(),
            frame=self._frame,
            buffer=self._buffer,
            is_rolling=self._is_rolling,
        )

    def make_proxemic(self, name: str, settings: RosParameters) -> SocialLayer:
        del settings
        return self._make_social(name, passes=False)

    def make_passing(self, name: str, settings: RosParameters) -> SocialLayer:
        del settings
        return self._make_social(name, passes=True)

    def _make_social(self, name: str, *, passes: bool) -> SocialLayer:
        settings = read_settings(SocialSettings, self._settings.section(name))
        return SocialLayer(self._node, name, settings, frame=self._frame, buffer=self._buffer, passes=passes)

    def make_bounded_explore(self, name: str, settings: RosParameters) -> BoundedExploreLayer:
        del settings
        own = read_settings(BoundedExploreSettings, self._settings.section(name))
        return BoundedExploreLayer(name, self._master, own)

    def _tracks_unknown(self, own: RosParameters) -> bool:
        default = self._settings.flag("track_unknown_space", default=False)
        return own.flag("track_unknown_space", default=default)

    def _sources(self, name: str, settings: RosParameters) -> list[ObservationSource]:
        """Read the observation sources of a layer, from the costmap's namespace or the layer's own."""
        if "observation_sources" not in settings:
            settings = self._settings.section(name)
        sources: list[ObservationSource] = []
        names = settings.text("observation_sources", "").split()
        self._node.log.info(f"    Subscribed to Topics: {' '.join(names)}")
        for source_name in names:
            section = settings.section(source_name)
            source = read_settings(SourceSettings, section)
            for field in ("obstacle_range", "raytrace_range"):
                if field not in section:
                    spaces = (settings, self._settings, self._root)
                    found = next((space for space in spaces if field in space), section)
                    setattr(source, field, found.number(field, getattr(source, field), minimum=0.0))
            source.topic = source.topic or source_name
            sources.append(ObservationSource(self._node, source, self._frame, self._buffer))
        return sources


_MAKERS: dict[str, Callable[[LayerMaker, str, RosParameters], "Layer"]] = {
    "StaticLayer": LayerMaker.make_static,
    "ObstacleLayer": LayerMaker.make_obstacles,
    "VoxelLayer": LayerMaker.make_voxels,
    "NonPersistentVoxelLayer": LayerMaker.make_forgetful_voxels,
    "SpatioTemporalVoxelLayer": LayerMaker.make_voxels,
    "RangeSensorLayer": LayerMaker.make_ranges,
    "ProxemicLayer": LayerMaker.make_proxemic,
    "PassingLayer": LayerMaker.make_passing,
    "InflationLayer": LayerMaker.make_inflation,
    "BoundedExploreLayer": LayerMaker.make_bounded_explore,
}


def _old_static(settings: RosParameters) -> StaticSettings:
    """Read the parameters from before Hydro, and the layer's namespace that replaced them."""
    static = read_settings(StaticSettings, settings.section("static_layer"))
    for old, field in (("map_topic", "map_topic"), ("unknown_cost_value", "unknown_cost_value")):
        if old in settings:
            setattr(static, field, getattr(read_settings(StaticSettings, settings), field))
    return static
