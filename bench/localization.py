"""amcl in the house of five rooms: from guesses 0.5 m and 20° beside, and from none, while a robot drives 53 m.

A hundred filters with the node's defaults follow one drive. The real nodes were not run: the house's README has their
figures.
"""

import json
import tempfile
from collections.abc import Sequence
from pathlib import Path
from statistics import median

from bench.navigation import HOUSE, housebot, launch
from bench.table import Row

_COUNT = 50
_LIMIT_S = 600
"""Longest time of the drive [s of the simulation]."""
_START = 9
_SETTLED_M, _FOUND_M = 5.0, 6.0
"""Way after which a filter with a guess, and one without, is judged."""
_NEAR_M, _NEAR_DEG = 0.2, 10.0
_REAL = {False: (0.040, 0.50), True: (0.071, 0.93)}
"""Median distance [m] and angle [deg] of the real node after 5 m, with the wheels' odometry and with worse."""
_FILTERS = """
  <node pkg="map_server" type="map_server" name="map_server" args="$(find house_nav)/maps/house.yaml"/>
"""
_FILTER = """
  <group ns="{name}">
    <remap from="scan" to="/scan"/>
    <remap from="static_map" to="/static_map"/>
    <node pkg="amcl" type="amcl" name="amcl">
      {parameters}
      <param name="base_frame_id" value="base_footprint"/>
      <param name="tf_broadcast" value="false"/>
    </node>
  </group>
"""
_PARAMETERS = {
    "defaults": '<param name="laser_max_range" value="8.0"/>',
    "turtlebot3": '<rosparam command="load" file="$(find house_nav)/config/amcl_tb3.yaml"/>',
}
_Errors = Sequence[Sequence[float]]
"""Way since the start [m], distance [m] and angle [deg] to the truth at each update."""


def errors(parameters: str, *, is_worse: bool) -> dict[str, _Errors]:
    """Drive once; return the errors of filters pose0, global0 and so on.

    Args:
        parameters: 'defaults' or 'turtlebot3'.
        is_worse: True: worse odometry.
    """
    names = [f"{kind}{number}" for kind in ("pose", "global") for number in range(_COUNT)]
    nodes = _FILTERS + "".join(_FILTER.format(name=name, parameters=_PARAMETERS[parameters]) for name in names)
    with tempfile.TemporaryDirectory() as name:
        out = Path(name) / "errors.json"
        tags = f"<count>{_COUNT}</count><tour>{HOUSE}/scripts/tour.py</tour><out>{out}</out>"
        tags = f'<plugin name="judge" filename="libjudge_filters.so">{tags}</plugin>'
        launch(Path(name), _START, housebot(tags, is_worse=is_worse), nodes, _LIMIT_S)
        return {row["name"].strip("/"): row["errors"] for row in json.loads(out.read_text())}


def _after(way_m: float, rows: _Errors) -> tuple[float, float]:
    """Return distance [m] and angle [deg] of the first update after a way; infinite without one."""
    return next(((distance, angle) for way, distance, angle in rows if way >= way_m), (float("inf"), float("inf")))


def _near(places: Sequence[tuple[float, float]]) -> int:
    return sum(distance <= _NEAR_M and angle <= _NEAR_DEG for distance, angle in places)


def run() -> list[Row]:
    """Judge both sets of parameters with both odometries."""
    if not HOUSE.is_dir():
        return []
    rows: list[Row] = []
    peer = "the real node, not in this run"
    for parameters in _PARAMETERS:
        for is_worse, odometry in ((False, "wheels"), (True, "made worse")):
            judged = errors(parameters, is_worse=is_worse)
            guessed = [_after(_SETTLED_M, judged[f"pose{number}"]) for number in range(_COUNT)]
            found = [_after(_FOUND_M, judged[f"global{number}"]) for number in range(_COUNT)]
            distance, angle = (median(values) for values in zip(*guessed, strict=True))
            name, (real_m, real_deg) = f"amcl, {parameters}, {odometry}", _REAL[is_worse]
            rows += [
                Row(f"{name}: after 5 m", distance, "m", peer, distance / real_m),
                Row(f"{name}: after 5 m", angle, "°", peer, angle / real_deg),
                Row(f"{name}: near the truth after 5 m, of {_COUNT}", _near(guessed), "", "", None),
                Row(f"{name}: found from nothing after 6 m, of {_COUNT}", _near(found), "", "", None),
            ]
    return rows
