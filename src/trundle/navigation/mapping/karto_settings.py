"""Karto's parameters, which slam_karto and slam_toolbox share, with the originals' names and defaults."""

import math
from typing import Annotated

from msgspec import Meta, Struct

from trundle.base.built import refuse_stale
from trundle.robots.parameters import RosParameters

from . import _mapping

refuse_stale(_mapping)
Length = Annotated[float, Meta(ge=0.0, le=1e6)]
Resolution = Annotated[float, Meta(ge=0.001, le=10.0)]
Window = Annotated[float, Meta(ge=0.0, le=40.0)]
Angle = Annotated[float, Meta(ge=0.0, le=math.pi)]
Step = Annotated[float, Meta(ge=0.001, le=math.pi)]
Ratio = Annotated[float, Meta(ge=0.0, le=1.0)]
Count = Annotated[int, Meta(ge=1, le=100_000)]
_LOOP_ANGLE_STEP = math.radians(1.0)
"""Coarser steps miss what is a few metres away."""
_LEAST_VARIANCE = 1e-6


class KartoSettings(Struct):
    """Lengths [m], angles [rad], times [s]; responses from 0 to 1."""

    odom_frame: str = "odom"
    map_frame: str = "map"
    base_frame: str = "base_link"
    throttle_scans: Count = 1
    resolution: Resolution = 0.05
    transform_publish_period: Length = 0.05
    map_update_interval: Length = 5.0
    use_scan_matching: bool = True
    use_scan_barycenter: bool = True
    minimum_travel_distance: Length = 0.2
    minimum_travel_heading: Angle = math.radians(10.0)
    scan_buffer_size: Count = 70
    scan_buffer_maximum_scan_distance: Length = 20.0
    link_match_minimum_response_fine: Ratio = 0.8
    link_scan_maximum_distance: Length = 10.0
    do_loop_closing: bool = True
    loop_search_maximum_distance: Length = 4.0
    loop_match_minimum_chain_size: Count = 10
    loop_match_maximum_variance_coarse: Length = 0.4
    """A standard deviation [m]."""
    loop_match_minimum_response_coarse: Ratio = 0.8
    loop_match_minimum_response_fine: Ratio = 0.8
    correlation_search_space_dimension: Window = 0.3
    correlation_search_space_resolution: Resolution = 0.01
    correlation_search_space_smear_deviation: Length = 0.03
    loop_search_space_dimension: Window = 8.0
    loop_search_space_resolution: Resolution = 0.05
    loop_search_space_smear_deviation: Length = 0.03
    distance_variance_penalty: Length = 0.3
    """A standard deviation [m]."""
    angle_variance_penalty: Length = math.radians(20.0)
    fine_search_angle_offset: Step = math.radians(0.2)
    coarse_search_angle_offset: Angle = math.radians(20.0)
    coarse_angle_resolution: Step = math.radians(2.0)
    minimum_angle_penalty: Ratio = 0.9
    minimum_distance_penalty: Ratio = 0.5

    def graph_options(self) -> _mapping.GraphOptions:
        """Return the options of the graph."""
        options = _mapping.GraphOptions()
        options.resolution = self.resolution
        options.least_distance, options.least_angle = self.minimum_travel_distance, self.minimum_travel_heading
        options.matches_scans, options.uses_center = self.use_scan_matching, self.use_scan_barycenter
        options.running_scans, options.running_distance = self.scan_buffer_size, self.scan_buffer_maximum_scan_distance
        options.link_response = self.link_match_minimum_response_fine
        options.link_distance = self.link_scan_maximum_distance
        options.closes_loops, options.loop_distance = self.do_loop_closing, self.loop_search_maximum_distance
        options.loop_chain = self.loop_match_minimum_chain_size
        options.loop_deviation = self.loop_match_maximum_variance_coarse
        options.loop_response_coarse = self.loop_match_minimum_response_coarse
        options.loop_response_fine = self.loop_match_minimum_response_fine
        options.window_resolution = self.correlation_search_space_resolution
        options.window_smear = self.correlation_search_space_smear_deviation
        options.loop_window_resolution = self.loop_search_space_resolution
        options.loop_window_smear = self.loop_search_space_smear_deviation
        options.search = self._search(self.correlation_search_space_dimension, self.coarse_angle_resolution)
        step = min(self.coarse_angle_resolution, _LOOP_ANGLE_STEP)
        options.loop_search = self._search(self.loop_search_space_dimension, step, is_penalized=False)
        return options

    def _search(self, dimension: float, angle_step: float, *, is_penalized: bool = True) -> _mapping.SearchOptions:
        search = _mapping.SearchOptions()
        search.half_width, search.half_angle = 0.5 * dimension, self.coarse_search_angle_offset
        search.angle_step, search.fine_angle_step = angle_step, self.fine_search_angle_offset
        search.is_penalized = is_penalized
        search.distance_variance = max(self.distance_variance_penalty**2, _LEAST_VARIANCE)
        search.angle_variance = max(self.angle_variance_penalty**2, _LEAST_VARIANCE)
        search.least_distance_factor = self.minimum_distance_penalty
        search.least_angle_factor = self.minimum_angle_penalty
        return search


def unused_parameters(parameters: RosParameters, known: set[str]) -> str:
    """Return a sentence on the parameters that are set and have no effect; empty if all have."""
    names = sorted(set(parameters.names()) - known)
    return f"parameters without effect here: {', '.join(names)}" if names else ""
