"""Filters over the last scans, beam by beam."""

from collections import deque
from collections.abc import Callable
from functools import partial

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, TransformBuffer

from .filter import ScanFilter
from .scan import Scan

_Array = NDArray[np.float32]
_Reduce = Callable[[_Array], _Array]
_MAX_OBSERVATIONS = 1000


def _median(observations: _Array) -> _Array:
    """Return the median of each column; of an even number of rows, the lower median, as in the original."""
    middle = (len(observations) - 1) // 2
    return np.partition(observations, middle, axis=0)[middle]


def _mean(observations: _Array) -> _Array:
    return observations.mean(axis=0, dtype=np.float64).astype(np.float32)


_KINDS: dict[str, _Reduce] = {"MedianFilterFloat": _median, "MeanFilterFloat": _mean}
"""Name of a filter of the package `filters`, without MultiChannel → its reduction."""


class Window:
    """A reduction of the last arrays to one."""

    def __init__(self, reduce: _Reduce, count: int) -> None:
        self._reduce = reduce
        self._observations: deque[_Array] = deque(maxlen=count)

    def apply(self, values: _Array) -> _Array:
        """Add an array and reduce; an array of another length discards those before."""
        if self._observations and self._observations[0].size != values.size:
            self._observations.clear()
        self._observations.append(values)
        return self._reduce(np.stack(self._observations)) if values.size else values


def _read_windows(parameters: RosParameters, name: str) -> list[Window]:
    windows: list[Window] = []
    for section in parameters.sections(name):
        type_name = section.text("type")
        kind = type_name.rpartition("/")[2].removeprefix("MultiChannel")
        if kind not in _KINDS:
            raise ParamError(f"{section.namespace}: no filter {type_name!r}; there are: {', '.join(_KINDS)}")
        count = section.section("params").integer("number_of_observations", minimum=1)
        windows.append(Window(_KINDS[kind], min(count, _MAX_OBSERVATIONS)))
    return windows


class ArraySettings(Struct):
    """Chains of filters."""


class LaserArrayFilter(ScanFilter):
    """Filters each beam's range and intensity over time: `range_filter_chain` and `intensity_filter_chain`."""

    Settings = ArraySettings
    is_reconfigurable = False
    _chains = ("range_filter_chain", "intensity_filter_chain")

    def __init__(self, name: str, parameters: RosParameters, node: Node, buffer: TransformBuffer) -> None:
        super().__init__(name, parameters, node, buffer)
        read = partial(_read_windows, parameters)
        self._ranges, self._intensities = (read(chain) for chain in self._chains)
        if not self._ranges and not self._intensities:
            raise ParamError(f"{parameters.namespace}: no filters; set {' or '.join(sorted(set(self._chains)))}")

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        for window in self._ranges:
            scan.ranges = window.apply(scan.ranges).copy()
        for window in self._intensities:
            scan.intensities = window.apply(scan.intensities).copy()
        return True


class LaserMedianFilter(LaserArrayFilter):
    """LaserArrayFilter with one chain for both, `internal_filter`."""

    _chains = ("internal_filter", "internal_filter")
