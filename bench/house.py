"""A furnished house of 38 mesh models; nine of them move and never sleep: chairs, balls and a door.

The peer is a plain loop of `mj_step` on the same compiled model. Times are of this process' CPU. Gazebo's rate was
measured with another house in another run.
"""

import statistics
import tempfile
from collections.abc import Sequence
from pathlib import Path

import trimesh

import trundle
from bench.loop import bare_loop, cpu_rate
from bench.table import Row
from trundle.sim.simulation import Simulation

_PAIRS = 5
_STEPS = 2000
_STEPS_PER_S = 1000
_GAZEBO = 31.8
"""[× real]"""
_Part = tuple[tuple[float, float, float], tuple[float, float, float]]
_FLOOR = """<model name="floor"><static>1</static><link name="l"><collision name="c"><geometry><plane>
<normal>0 0 1</normal></plane></geometry></collision></link></model>"""
_MODEL = """<model name="{name}">{options}<pose>{pose} 0 0 0</pose><link name="l">{inertial}<collision name="c">
<geometry><mesh><uri>{mesh}</uri></mesh></geometry></collision></link>{joint}</model>"""
_INERTIAL = """<inertial><pose>0 0 {height} 0 0 0</pose><mass>5</mass><inertia><ixx>0.3</ixx><iyy>0.3</iyy>
<izz>0.2</izz></inertia></inertial>"""
_HINGE = """<joint name="hinge" type="revolute"><parent>world</parent><child>l</child><axis><xyz>0 0 1</xyz><limit>
<lower>-1.5</lower><upper>1.5</upper></limit></axis></joint>"""
_STATIC = {
    "room": ["0 0 0"],
    "table": ["-2 1.2 0", "2.5 -2.2 0", "-3.1 -2.2 0", "2 1.2 0", "3.1 2.3 0"],
    "sofa": ["2 2.4 0", "2 -0.6 0"],
    "shelf": [f"{-3.4 + i} {side * 2.75} 0" for i in range(3) for side in (1, -1)] + ["3.5 0 0", "3.5 -1.1 0"],
    "lamp": ["0.5 2.6 0", "3.7 2.8 0", "-3.7 -0.5 0", "0.5 -2.6 0", "-3.7 0.6 0", "3.7 1.1 0"],
    "vase": [f"{-2.6 + 0.3 * i} 1.2 0.75" for i in range(5)] + ["2.5 -2.2 0.75", "2 1.2 0.75"],
}
_MOVING = {
    "chair": ["-2.6 0.3 0", "-2 0.3 0", "-1.4 0.3 0", "-2.4 2.1 0", "-1.6 2.1 0", "2.5 -1.5 0"],
    "ball": ["1 -1.5 0.3", "-1 -1 0.5"],
}


def run() -> list[Row]:
    """Alternate simulation and loop, so that a varying machine speed affects both equally."""
    sim = _house()
    sim.step(_STEPS)
    loop = bare_loop(sim)
    pairs = [(cpu_rate(sim.step, _STEPS), cpu_rate(loop, _STEPS)) for _ in range(_PAIRS)]
    value = statistics.median(simulation for simulation, _ in pairs) / _STEPS_PER_S
    ratio = statistics.median(simulation / loop_rate for simulation, loop_rate in pairs)
    return [Row(f"furnished house, awake (Gazebo 11: {_GAZEBO})", value, "× real", "mj_step on the same", ratio)]


def _house() -> Simulation:
    with tempfile.TemporaryDirectory() as folder:
        for name, mesh in _meshes().items():
            mesh.export(Path(folder) / f"{name}.stl")
        models = _FLOOR
        for kind, name, pose in _named(_STATIC):
            models += _model(folder, kind, name, pose, options="<static>1</static>")
        awake = "<allow_auto_disable>0</allow_auto_disable>"
        for kind, name, pose in _named(_MOVING):
            inertial = _INERTIAL.format(height=0.4 if kind == "chair" else 0)
            models += _model(folder, kind, name, pose, options=awake, inertial=inertial)
        door = _INERTIAL.format(height=1)
        models += _model(folder, "door", "door", "0 0.05 0.01", options=awake, inertial=door, joint=_HINGE)
        file = Path(folder) / "house.world"
        file.write_text(f'<sdf version="1.6"><world name="w">{models}</world></sdf>')
        return trundle.load(str(file))


def _named(poses_by_kind: dict[str, list[str]]) -> list[tuple[str, str, str]]:
    return [(kind, f"{kind}{i}", pose) for kind, poses in poses_by_kind.items() for i, pose in enumerate(poses)]


def _model(folder: str, kind: str, name: str, pose: str, *, options: str, inertial: str = "", joint: str = "") -> str:
    mesh = f"{folder}/{kind}.stl"
    return _MODEL.format(name=name, options=options, pose=pose, inertial=inertial, mesh=mesh, joint=joint)


def _meshes() -> dict[str, trimesh.Trimesh]:
    return {
        "room": _boxes(
            *(((8, 0.1, 2.5), (0, y, 1.25)) for y in (3, -3)),
            *(((0.1, 6, 2.5), (x, 0, 1.25)) for x in (4, -4)),
            ((0.1, 2, 2.5), (0, 2, 1.25)),
            ((0.1, 2.9, 2.5), (0, -1.55, 1.25)),
        ),
        "table": _boxes(((1.2, 0.8, 0.04), (0, 0, 0.73)), *_legs(0.55, 0.35, 0.06, 0.71)),
        "chair": _boxes(
            ((0.42, 0.42, 0.04), (0, 0, 0.45)), ((0.04, 0.42, 0.5), (-0.19, 0, 0.72)), *_legs(0.18, 0.18, 0.04, 0.43)
        ),
        "sofa": _boxes(
            ((2, 0.9, 0.4), (0, 0, 0.2)), ((2, 0.25, 0.45), (0, 0.32, 0.6)), ((0.25, 0.9, 0.25), (0.9, 0, 0.5))
        ),
        "shelf": _boxes(
            *(((0.02, 0.3, 1.8), (x, 0, 0.9)) for x in (-0.45, 0.45)),
            *(((0.9, 0.3, 0.02), (0, 0, 0.01 + 0.35 * i)) for i in range(6)),
        ),
        "lamp": _joined([_cylinder(0.15, 0.03, 0.015), _cylinder(0.02, 1.5, 0.78), _cylinder(0.2, 0.3, 1.6)]),
        "vase": _boxes(
            ((0.16, 0.16, 0.02), (0, 0, 0.01)),
            *(((0.02, 0.16, 0.28), (x, 0, 0.16)) for x in (-0.07, 0.07)),
            *(((0.12, 0.02, 0.28), (0, y, 0.16)) for y in (-0.07, 0.07)),
        ),
        "ball": trimesh.creation.icosphere(subdivisions=3, radius=0.12),
        "door": _boxes(((0.04, 0.85, 2), (0, 0.43, 1))),
    }


def _legs(x: float, y: float, width: float, height: float) -> Sequence[_Part]:
    return [((width, width, height), (sx * x, sy * y, height / 2)) for sx in (-1, 1) for sy in (-1, 1)]


def _boxes(*parts: _Part) -> trimesh.Trimesh:
    boxes = [trimesh.creation.box(extents=size) for size, _ in parts]
    for box, (_, position) in zip(boxes, parts, strict=True):
        box.apply_translation(position)
    return _joined(boxes)


def _joined(meshes: list[trimesh.Trimesh]) -> trimesh.Trimesh:
    joined = trimesh.util.concatenate(meshes)
    assert isinstance(joined, trimesh.Trimesh)
    return joined


def _cylinder(radius: float, height: float, z: float) -> trimesh.Trimesh:
    mesh = trimesh.creation.cylinder(radius, height, sections=12)
    mesh.apply_translation((0, 0, z))
    return mesh
