"""Cost of large worlds: hundreds of robots, thousands of boxes, meshes of a million faces.

A row of larger worlds divides by their size, and its peer is the smallest: 1 is linear. Times are of this process' CPU.
"""

import statistics
import tempfile
import time
from pathlib import Path

import trimesh

import trundle
from bench.loop import bare_loop, cpu_rate
from bench.robots import rolling_robots
from bench.table import Row
from trundle.sim.simulation import Simulation

_ROBOTS = (100, 400, 1_000)
_BOXES = 3_000
_SUBDIVISIONS = (6, 7, 8)
"""Subdivisions of icospheres, which have 20 × 4^n faces: 82 thousand to 1.3 million."""
_PAIRS = 5
_STEPS = 20
_FLOOR = """<model name="floor"><static>1</static><link name="l"><collision name="c"><geometry><plane/></geometry>
</collision></link></model>"""
_BOX = """<model name="b{0}"><pose>{1} {2} 0.1 0 0 0</pose>{3}<link name="l"><inertial><mass>1</mass><inertia>
<ixx>0.007</ixx><iyy>0.007</iyy><izz>0.007</izz></inertia></inertial><collision name="c"><geometry><box>
<size>0.2 0.2 0.2</size></box></geometry></collision></link></model>"""
_AWAKE = "<allow_auto_disable>0</allow_auto_disable>"
_MESH = """<sdf version="1.6"><model name="m"><link name="l"><collision name="c"><geometry><mesh><uri>{}</uri></mesh>
</geometry></collision></link></model></sdf>"""


def run() -> list[Row]:
    """Load larger and larger worlds, and step large ones."""
    return [*_robots(), *_boxes(), *_meshes()]


def _robots() -> list[Row]:
    costs = {count: _first_step_s(count) / count for count in _ROBOTS}
    least = _ROBOTS[0]
    return [
        Row(f"one of {count:,} RP2W, to the first step", 1e3 * cost, "ms CPU", f"one of {least}", cost / costs[least])
        for count, cost in costs.items()
    ]


def _first_step_s(count: int) -> float:
    start = time.process_time()
    rolling_robots(count, rolling=0).step(1)
    return time.process_time() - start


def _boxes() -> list[Row]:
    """Boxes on a plane, every one awake or all asleep; the peer loops `mj_step` on the same compiled model."""
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as folder:
        for what, how, settle in (("awake", _AWAKE, 100), ("asleep", "", 1_500)):
            sim = _box_world(Path(folder), how)
            sim.step(settle)
            loop = bare_loop(sim)
            loop(_STEPS)
            pairs = [(cpu_rate(sim.step, _STEPS), cpu_rate(loop, _STEPS)) for _ in range(_PAIRS)]
            value, ratio = statistics.median(a for a, _ in pairs), statistics.median(a / b for a, b in pairs)
            rows.append(Row(f"{_BOXES:,} boxes {what}", value, "steps/s", "mj_step on the same", ratio))
    return rows


def _box_world(folder: Path, how: str) -> Simulation:
    boxes = "".join(_BOX.format(i, 0.5 * (i % 60), 0.5 * (i // 60), how) for i in range(_BOXES))
    file = folder / "boxes.world"
    file.write_text(f'<sdf version="1.6"><world name="w">{_FLOOR}{boxes}</world></sdf>')
    return trundle.load(str(file))


def _meshes() -> list[Row]:
    """Convex meshes, without what an earlier load has kept of them."""
    costs: dict[int, float] = {}
    with tempfile.TemporaryDirectory() as folder:
        for number in _SUBDIVISIONS:
            mesh = trimesh.creation.icosphere(subdivisions=number, radius=0.5)
            mesh.export(Path(folder) / f"{number}.stl")
            file = Path(folder) / f"{number}.sdf"
            file.write_text(_MESH.format(f"{number}.stl"))
            start = time.process_time()
            trundle.load(str(file)).step(1)
            costs[len(mesh.faces)] = time.process_time() - start
    least = min(costs)
    return [
        Row(
            f"convex mesh of {faces:,} faces, to the first step", cost, "s CPU", f"{least:,} faces, by the face",
            cost / faces / (costs[least] / least),
        )
        for faces, cost in costs.items()
    ]  # fmt: skip
