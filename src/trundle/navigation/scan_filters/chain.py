"""A chain of filters, as YAML lists it."""

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, TransformBuffer

from .array_filters import LaserArrayFilter, LaserMedianFilter
from .beam_filters import (
    InterpolationFilter,
    LaserScanAngularBoundsFilter,
    LaserScanAngularBoundsFilterInPlace,
    LaserScanIntensityFilter,
    LaserScanMaskFilter,
    LaserScanRangeFilter,
    LaserScanSectorFilter,
)
from .filter import ScanFilter
from .neighbor_filters import LaserScanSpeckleFilter, ScanShadowsFilter
from .region_filters import LaserScanBoxFilter, LaserScanFootprintFilter, LaserScanPolygonFilter
from .scan import Scan

_KINDS: tuple[type[ScanFilter], ...] = (
    InterpolationFilter,
    LaserArrayFilter,
    LaserMedianFilter,
    LaserScanAngularBoundsFilter,
    LaserScanAngularBoundsFilterInPlace,
    LaserScanBoxFilter,
    LaserScanFootprintFilter,
    LaserScanIntensityFilter,
    LaserScanMaskFilter,
    LaserScanPolygonFilter,
    LaserScanRangeFilter,
    LaserScanSectorFilter,
    LaserScanSpeckleFilter,
    ScanShadowsFilter,
)
FILTERS = {kind.__name__: kind for kind in _KINDS} | {"StaticLaserScanPolygonFilter": LaserScanPolygonFilter}
"""Type without `laser_filters/` → filter."""


class FilterChain:
    """Filters one after the other."""

    def __init__(self, sections: list[RosParameters], node: Node, buffer: TransformBuffer) -> None:
        """Make the filters of a list of {name, type, params}; unknown types are left out with an error in the log.

        Raises:
            ParamError: a parameter is missing or invalid, or a name is a duplicate.
        """
        self.filters: list[ScanFilter] = []
        for section in sections:
            name, type_name = section.text("name"), section.text("type")
            kind = FILTERS.get(type_name.rpartition("/")[2])
            if kind is None:
                known = ", ".join(FILTERS)
                node.log.error(f"filter {name!r} is left out: no type {type_name!r}; there are: {known}")
                continue
            if any(other.name == name for other in self.filters):
                raise ParamError(f"{section.namespace}: duplicate name {name!r}")
            self.filters.append(kind(name, section.section("params"), node, buffer))

    def apply(self, scan: Scan) -> str:
        """Filter a scan in place; returns the fault of the filter that failed, or an empty text."""
        for item in self.filters:
            if not item.apply(scan):
                return f"{item.name}: {item.fault}"
        return ""
