"""slam_karto/slam_karto: makes a map by a pose graph, and closes loops."""

from collections.abc import Coroutine, Mapping
from typing import Any, ClassVar

from .graph_node import GraphMappingNode
from .karto_settings import KartoSettings, Length


class SlamKartoSettings(KartoSettings):
    """Lengths [m], times [s]."""

    vis_publish_period: Length = 2.0


class SlamKarto(GraphMappingNode[SlamKartoSettings]):
    """Publishes `map`, `map_metadata`, `visualization_marker_array` and the transform of the odometry frame.

    Parameters, with the original's names and defaults: `SlamKartoSettings`; those of solvers have no effect. Service
    `dynamic_map`. A scan is matched with those before it, with older ones that are linked with it, and with chains of
    scans nearby that would close a loop; a loop that would bend the graph beyond its uncertainty is refused.
    """

    kind = SlamKartoSettings
    aliases: ClassVar[Mapping[str, str]] = {"delta": "resolution"}  # gmapping's name

    def _advertise(self, settings: SlamKartoSettings) -> None:
        del settings
        self._advertise_map("map", "map_metadata", "dynamic_map")

    def _jobs(self, settings: SlamKartoSettings) -> list[Coroutine[Any, Any, None]]:
        jobs = super()._jobs(settings)
        if settings.vis_publish_period > 0.0:
            jobs.append(self._publish_markers("visualization_marker_array", settings.vis_publish_period))
        return jobs
