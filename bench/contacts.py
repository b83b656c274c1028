"""Worlds with many contacts, or with contact laws that MuJoCo lacks: the simulation against a loop of `mj_step`.

The loop steps the same bodies with the same options and without those laws, from the simulation's state. Times are of
this process' CPU. Gazebo 11's rates were measured in another run.
"""

import statistics
import tempfile
from dataclasses import dataclass
from pathlib import Path

import trundle
from bench.loop import bare_loop, cpu_rate
from bench.table import Row
from trundle.sim.simulation import Simulation

_PAIRS = 5
_FLOOR = """<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane><normal>0 0 1
</normal></plane></geometry>{}</collision></link></model>"""
_BODY = """<model name="m{name}"><pose>{pose} 0 0 0</pose>{link}</model>"""
_LINK = """<link name="{name}"><pose>{pose}</pose><inertial><mass>{mass}</mass><inertia><ixx>{ixx}</ixx><iyy>{iyy}</iyy>
<izz>{izz}</izz></inertia></inertial><collision name="c"><geometry>{shape}</geometry>{surface}</collision></link>"""
_BOUNCY = """<surface><bounce><restitution_coefficient>1</restitution_coefficient><threshold>0.01</threshold></bounce>
</surface>"""
_GRAIN = """<surface><friction><ode><mu>1</mu><mu2>0.5</mu2><fdir1>0 0 1</fdir1></ode></friction></surface>"""


@dataclass(frozen=True, slots=True)
class _Scene:
    name: str
    models: str
    steps: int
    gazebo: float
    """Rate of Gazebo 11.1 on two cores [steps/s]."""
    wheels: int = 0
    """Number of driven wheels of model `m0`."""


def run() -> list[Row]:
    """Alternate simulation and loop, so that a varying machine speed affects both equally."""
    rows: list[Row] = []
    for scene in (_skid(), _balls(), _wall()):
        sim = _load(scene)
        loop = bare_loop(sim)
        sim.step(scene.steps // 4)
        loop(scene.steps // 4)
        pairs = [(cpu_rate(sim.step, scene.steps), cpu_rate(loop, scene.steps)) for _ in range(_PAIRS)]
        value = statistics.median(a for a, _ in pairs)
        name = f"{scene.name} (Gazebo 11: {scene.gazebo:,.0f})"
        rows.append(Row(name, value, "steps/s", "mj_step on the same", statistics.median(a / b for a, b in pairs)))
    return rows


def _skid() -> _Scene:
    links = _LINK.format(
        name="base",
        pose="0 0 0.15 0 0 0",
        mass=20,
        ixx=0.3,
        iyy=0.5,
        izz=0.7,
        shape=_box_shape(0.5, 0.3, 0.1),
        surface="",
    )
    for i, (x, y) in enumerate((x, y) for x in (0.2, -0.2) for y in (0.25, -0.25)):
        cylinder = "<cylinder><radius>0.1</radius><length>0.08</length></cylinder>"
        pose = f"{x} {y} 0.1 -1.5707963267948966 0 0"
        links += _LINK.format(
            name=f"w{i}", pose=pose, mass=1, ixx=0.003, iyy=0.003, izz=0.005, shape=cylinder, surface=_GRAIN
        )
        links += f"""<joint name="w{i}" type="revolute"><parent>base</parent><child>w{i}</child>
            <axis><xyz>0 0 1</xyz></axis></joint>"""
    robot = _BODY.format(name=0, pose="0 0 0", link=links)
    return _Scene("skid, fdir1 and mu ≠ mu2", _FLOOR.format("") + robot, 4000, 11_562, wheels=4)


def _balls() -> _Scene:
    models = _FLOOR.format(_BOUNCY)
    for i in range(20):
        sphere = "<sphere><radius>0.1</radius></sphere>"
        link = _LINK.format(
            name="l", pose="0 0 0 0 0 0", mass=1, ixx=0.004, iyy=0.004, izz=0.004, shape=sphere, surface=_BOUNCY
        )
        models += _BODY.format(name=i, pose=f"{i % 5} {i // 5} {0.2 + 0.02 * i}", link=link)
    return _Scene("20 balls that bounce, e = 1", models, 4000, 19_116)


def _wall() -> _Scene:
    models = _FLOOR.format("")
    for i in range(100):
        row, column = divmod(i, 10)
        link = _LINK.format(
            name="l",
            pose="0 0 0 0 0 0",
            mass=2,
            ixx=0.0033,
            iyy=0.0083,
            izz=0.0083,
            shape=_box_shape(0.2, 0.1, 0.1),
            surface="",
        )
        pose = f"{(column + 0.5 * (row % 2)) * 0.201} 0 {0.05 + 0.1 * row}"
        models += _BODY.format(name=i, pose=pose, link=link).replace(
            "<link", "<allow_auto_disable>0</allow_auto_disable><link", 1
        )
    return _Scene("brick wall of 100, awake", models, 200, 256)


def _box_shape(x: float, y: float, z: float) -> str:
    return f"<box><size>{x} {y} {z}</size></box>"


def _load(scene: _Scene) -> Simulation:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.world"
        file.write_text(f'<sdf version="1.6"><world name="w"><gravity>0 0 -9.8</gravity>{scene.models}</world></sdf>')
        sim = trundle.load(str(file))
    for i in range(scene.wheels):
        sim["m0"].joint(f"w{i}").command_velocity(2.0 + 2.0 * (i % 2), max_effort=50.0)
    return sim
