"""slam_gmapping's parameters, with the original's names and defaults."""

import math
from typing import NamedTuple

from msgspec import Struct, structs

from trundle.base.built import refuse_stale
from trundle.robots.parameters import ParamError, RosParameters

from . import _mapping

refuse_stale(_mapping)
_RANGE_MARGIN_M = 0.01
_MAX_CELLS = 400_000_000
_PATCH, _MARGIN_M = 32, 10.0
"""Size of gmapping's patches of a map [cells], and margin by which a map grows beyond the seen cells [m]."""
_MAX_PARTICLES = 10_000


class MapFrame(NamedTuple):
    """Cells of a published map; cell (0, 0) begins in the origin."""

    first_column: int
    first_row: int
    width: int
    height: int

    def grown(self, seen: tuple[int, int, int, int], delta_m: float) -> "MapFrame":
        """Return the part of the map to publish around the seen cells: first column and row, last column and row.

        As in gmapping, it grows by whole patches, to 10 m beyond the seen cells, on the sides where these exceed it.
        """
        margin = math.ceil(_MARGIN_M / delta_m)
        first_column, width = _grown(self.first_column, self.width, seen[0], seen[2], margin)
        first_row, height = _grown(self.first_row, self.height, seen[1], seen[3], margin)
        frame = MapFrame(first_column, first_row, width, height)
        return frame if width * height <= _MAX_CELLS else self


def _grown(first: int, count: int, seen_first: int, seen_last: int, margin: int) -> tuple[int, int]:
    """Return first cell and number of cells along one axis."""
    before = -(-(first - seen_first + margin) // _PATCH) * _PATCH if seen_first < first else 0
    after = -(-(seen_last + margin - first - count + 1) // _PATCH) * _PATCH if seen_last >= first + count else 0
    return first - before, before + count + after


def _begun(low_m: float, high_m: float, delta_m: float) -> tuple[int, int]:
    """Return first cell and number of cells along one axis before the first scan."""
    count = max(math.ceil((high_m - low_m) / delta_m - 1e-6), 0) // _PATCH * _PATCH
    return math.floor((low_m if count else (low_m + high_m) / 2.0) / delta_m + 0.5), count


class GmappingSettings(Struct, frozen=True, kw_only=True):
    """Lengths [m], angles [rad], times [s]."""

    throttle_scans: int = 1
    base_frame: str = "base_link"
    map_frame: str = "map"
    odom_frame: str = "odom"
    transform_publish_period: float = 0.05
    tf_delay: float = -1.0
    """Negative, as by default: transform_publish_period."""
    map_update_interval: float = 5.0
    maxRange: float = 0.0  # noqa: N815
    """0: the laser's maximum range minus 0.01."""
    maxUrange: float = 0.0  # noqa: N815
    """0: maxRange."""
    minimumScore: float = 0.0  # noqa: N815
    sigma: float = 0.05
    kernelSize: int = 1  # noqa: N815
    lstep: float = 0.05
    astep: float = 0.05
    iterations: int = 5
    lsigma: float = 0.075
    ogain: float = 3.0
    lskip: int = 0
    srr: float = 0.1
    srt: float = 0.2
    str: float = 0.1
    stt: float = 0.2
    linearUpdate: float = 1.0  # noqa: N815
    angularUpdate: float = 0.5  # noqa: N815
    temporalUpdate: float = -1.0  # noqa: N815
    resampleThreshold: float = 0.5  # noqa: N815
    particles: int = 30
    xmin: float = -100.0
    ymin: float = -100.0
    xmax: float = 100.0
    ymax: float = 100.0
    delta: float = 0.05
    occ_thresh: float = 0.25
    llsamplerange: float = 0.01
    llsamplestep: float = 0.01
    lasamplerange: float = 0.005
    lasamplestep: float = 0.005

    @property
    def frame(self) -> "MapFrame":
        """The map before the first scan: whole patches from xmin and ymin on, as in gmapping.

        Where the bounds leave no room, as 10 … -10, it begins with nothing at their middle, and grows.
        """
        first_column, width = _begun(self.xmin, self.xmax, self.delta)
        first_row, height = _begun(self.ymin, self.ymax, self.delta)
        return MapFrame(first_column, first_row, width, height)

    def slam_options(self, *, range_max_m: float) -> _mapping.SlamOptions:
        """Return the options of the filter for a laser with a maximum range [m]."""
        options = _mapping.SlamOptions()
        options.max_range = self.maxRange or range_max_m - _RANGE_MARGIN_M
        options.usable_range = self.maxUrange or options.max_range
        options.sigma, options.kernel_size, options.iterations = self.sigma, self.kernelSize, self.iterations
        options.linear_step, options.angular_step = self.lstep, self.astep
        options.likelihood_sigma, options.likelihood_gain, options.skipped_beams = self.lsigma, self.ogain, self.lskip
        options.srr, options.srt, options.str, options.stt = self.srr, self.srt, self.str, self.stt
        options.linear_update, options.angular_update = self.linearUpdate, self.angularUpdate
        options.temporal_update, options.resample_threshold = self.temporalUpdate, self.resampleThreshold
        options.minimum_score, options.particles, options.delta = self.minimumScore, self.particles, self.delta
        return options


_POSITIVE = ("delta", "sigma", "lsigma", "ogain", "particles")


def read_settings(parameters: RosParameters) -> GmappingSettings:
    """Read slam_gmapping's private parameters.

    Raises:
        ParamError: a parameter has the wrong type or is out of bounds.
    """
    values: dict[str, float | str] = {}
    for name, default in structs.asdict(GmappingSettings()).items():
        match default:
            case int():
                values[name] = parameters.integer(name, default)
            case float():
                values[name] = parameters.number(name, default)
            case _:
                values[name] = parameters.text(name, default).lstrip("/")
    settings = GmappingSettings(**values)  # pyright: ignore[reportArgumentType]  # each of its default's type
    for name in _POSITIVE:
        if not getattr(settings, name) > 0:
            raise ParamError(f"parameter {parameters.namespace}/{name} must be > 0, got {getattr(settings, name):g}")
    _, _, width, height = settings.frame
    if width * height > _MAX_CELLS:
        raise ParamError(
            f"{parameters.namespace}: xmin … ymax make a map of {width} × {height} cells; at most {_MAX_CELLS}"
        )
    if settings.particles > _MAX_PARTICLES:
        raise ParamError(f"parameter {parameters.namespace}/particles must be at most {_MAX_PARTICLES}")
    if settings.tf_delay < 0.0:
        settings = structs.replace(settings, tf_delay=settings.transform_publish_period)
    return settings
