"""Extreme numbers end in a sentence or a stable world."""

import contextlib
from pathlib import Path

import numpy as np
import pytest

import trundle
from trundle.base.diagnostics import TrundleError

BALL = "<sphere><radius>0.1</radius></sphere>"
LIMIT = "<limit><lower>{}</lower><upper>{}</upper><effort>{}</effort><velocity>{}</velocity></limit>"


def world(
    *,
    step: str = "0.001",
    gravity: str = "0 0 -9.8",
    mass: str = "1",
    inertia: str = "0.01",
    shape: str = BALL,
    surface: str = "",
    pose: str = "0 0 0.05 0 0 0",
    joint: str = "",
) -> str:
    moments = "".join(f"<{m}>{inertia}</{m}>" for m in ("ixx", "iyy", "izz"))
    link = (
        f'<link name="l"><inertial><mass>{mass}</mass><inertia>{moments}<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>'
        f'</inertial><collision name="c"><geometry>{shape}</geometry><surface>{surface}</surface></collision></link>'
    )
    floor = '<link name="l"><collision name="c"><geometry><plane/></geometry></collision></link>'
    return (
        f'<sdf version="1.7"><world name="w"><physics type="ode"><max_step_size>{step}</max_step_size></physics>'
        f'<gravity>{gravity}</gravity><model name="f"><static>1</static>{floor}</model>'
        f'<model name="m"><pose>{pose}</pose>{link}{joint}</model></world></sdf>'
    )


def joint(kind: str, axis: str = "0 0 1", inside: str = "", more: str = "") -> str:
    return (
        f'<link name="k"/><joint name="j" type="{kind}"><parent>l</parent><child>k</child>'
        f"<axis><xyz>{axis}</xyz>{inside}</axis>{more}</joint>"
    )


def dynamics(value: str) -> str:
    words = ("damping", "friction", "spring_stiffness", "spring_reference")
    return f"<dynamics>{''.join(f'<{word}>{value}</{word}>' for word in words)}</dynamics>"


WORLDS = {
    **{f"step {v}": world(step=v) for v in ("0", "-1", "1e-12", "10", "1e300", "nan")},
    **{f"gravity {v}": world(gravity=v) for v in ("0 0 1e300", "nan 0 0")},
    **{f"mass {v}": world(mass=v) for v in ("1e300", "1e-300", "-5", "inf")},
    **{f"inertia {v}": world(inertia=v) for v in ("1e300", "1e-300", "-5")},
    **{f"radius {v}": world(shape=f"<sphere><radius>{v}</radius></sphere>") for v in ("1e300", "-1", "0")},
    **{f"box {v}": world(shape=f"<box><size>{v}</size></box>") for v in ("0 0 0", "1e30 1 1", "-1 -1 -1")},
    "cone of nothing": world(shape="<cone><radius>0</radius><length>0</length></cone>"),
    "polyline of a point": world(shape="<polyline><point>0 0</point><height>1</height></polyline>"),
    "endless friction": world(
        surface="<friction><ode><mu>1e300</mu><mu2>-1</mu2><fdir1>1e300 0 0</fdir1></ode></friction>"
    ),
    "friction along the normal": world(
        surface="<friction><ode><mu>0.5</mu><mu2>0.2</mu2><fdir1>0 0 1</fdir1></ode></friction>"
    ),
    **{
        f"kp {v}": world(surface=f"<contact><ode><kp>{v}</kp><kd>{v}</kd></ode></contact>") for v in ("0", "-1", "1e-5")
    },
    "endless bounce": world(
        surface="<bounce><restitution_coefficient>1e9</restitution_coefficient><threshold>-1</threshold></bounce>"
    ),
    "endless mask": world(surface="<contact><collide_bitmask>99999999999</collide_bitmask></contact>"),
    "far away": world(pose="1e300 0 0 0 0 0"),
    "no axis": world(joint=joint("revolute", "0 0 0")),
    "limits crossed": world(joint=joint("revolute", inside=LIMIT.format("1e300", "-1e300", 1, 1))),
    "no effort": world(joint=joint("revolute", inside=LIMIT.format(-1, 1, 0, 0))),
    "a hair's breadth": world(joint=joint("prismatic", inside=LIMIT.format(0, "1e-12", 1, 1))),
    **{f"dynamics {v}": world(joint=joint("revolute", inside=dynamics(v))) for v in ("1e300", "-1e300", "inf")},
    **{
        f"pitch {v}": world(joint=joint("screw", more=f"<thread_pitch>{v}</thread_pitch>"))
        for v in ("0", "1e-300", "1e300")
    },
    "parallel axes": world(joint=joint("revolute2")),
    "gears without a housing": world(joint=joint("gearbox", more="<gearbox_ratio>1e300</gearbox_ratio>")),
}


@pytest.mark.parametrize("name", WORLDS)
def test_an_extreme_world(name: str, tmp_path: Path) -> None:
    file = tmp_path / "w.world"
    file.write_text(WORLDS[name])
    with contextlib.suppress(TrundleError):
        sim = trundle.load(str(file))
        with contextlib.suppress(TrundleError):
            sim.step(50)
            for handle in sim["m"].joints:
                if handle.is_driven:
                    handle.command_velocity(1.0)
                    sim.step(20)
                    handle.command_effort(1.0)
                    sim.step(20)
        assert np.isfinite(sim.snapshot().poses).all()
        assert np.isfinite(sim.snapshot().twists).all()
