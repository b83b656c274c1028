"""Worlds that the precheck accepts compile without findings."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, strategies as st

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.robots.description import load, load_text
from trundle.robots.lint.physics_precheck import _eigenvalues, physics_accepts
from trundle.robots.model import Inertial, World, flattened
from trundle.robots.packages import Packages
from trundle.sim.physics import compile_world

INERTIAL = (
    "<inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz><ixy>0.01</ixy></inertia></inertial>"
)
BOX = "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision>"
AXIS = "<axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>"
CART = f"""<model name='cart'><link name='base'>{INERTIAL}{BOX}</link>
<link name='arm'><pose>0 0 3 0 0 0</pose>{INERTIAL}</link>
<joint name='hinge' type='revolute'><parent>base</parent><child>arm</child>{AXIS}</joint></model>
<model name='ground'><static>1</static><link name='l'>
<collision name='c'><geometry><plane/></geometry></collision></link></model>"""


def world(body: str) -> World:
    text = f"<sdf version='1.7'><world name='w'>{body}</world></sdf>"
    here = Path(__file__).parent
    packages = Packages({}, start=here)
    return flattened(load_text(text, name="x.sdf", folder=here, packages=packages, report=Diagnostics()).world)


def test_a_robot_that_physics_takes_as_it_is_needs_no_engine() -> None:
    report = Diagnostics()
    compile_world(world(CART), report)
    assert report.findings == []

    assert physics_accepts(world(CART))


@pytest.mark.parametrize(
    ("was", "now"),
    [
        ("<mass>2", "<mass>0"),
        ("<ixx>0.1", "<ixx>0.3"),
        ("<ixy>0.01", "<ixy>0.1"),
        ("<size>1 2 3", "<size>1 2 0"),
        ("<box><size>1 2 3</size></box>", "<mesh><uri>lost.stl</uri></mesh>"),
        ("<box><size>1 2 3</size></box>", "<plane/>"),
        ("<lower>-1", "<lower>1"),
        ("<lower>-1", "<lower>2"),
        ("type='revolute'", "type='universal'"),
        ("</axis>", "<dynamics><damping>-1</damping></dynamics></axis>"),
        ("<child>arm", "<child>world"),
        ("</joint>", "</joint><joint name='b' type='fixed'><parent>base</parent><child>arm</child></joint>"),
        ("</joint>", "</joint><joint name='b' type='fixed'><parent>arm</parent><child>base</child></joint>"),
        ("<plane/></geometry>", "<plane/></geometry><surface><friction><ode><fdir1>1 0 0</fdir1></ode></friction>"
         "</surface>"),
    ],
)  # fmt: skip
def test_values_that_physics_may_repair_clamp_or_refuse_fail_the_precheck(was: str, now: str) -> None:
    assert was in CART
    assert not physics_accepts(world(CART.replace(was, now)))


_MOMENTS = st.floats(-10, 10)


@example((0.0, 0.0, 0.0), (0.0, 0.0, 1.3634676056435316e-150))
@example((1e200, 2e200, 3e200), (0.0, 0.0, 1e199))
@given(st.tuples(_MOMENTS, _MOMENTS, _MOMENTS), st.tuples(_MOMENTS, _MOMENTS, _MOMENTS))
def test_the_principal_moments_are_those_of_the_matrix(
    moments: tuple[float, float, float], products: tuple[float, float, float]
) -> None:
    (xx, yy, zz), (xy, xz, yz) = moments, products
    scale = max(map(abs, (*moments, *products)))

    actual = sorted(_eigenvalues(Inertial(mass=1.0, moments=moments, products=products)))

    expected = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    assert actual == pytest.approx(
        expected.tolist(), abs=1e-6 * max(scale, 1e-3)
    )  # acos loses half its digits at its ends


def test_checking_a_plain_robot_loads_no_engine(tmp_path: Path) -> None:
    wheel = (
        "<collision name='c'><pose>0 0 0 1.5707963 0 0</pose><geometry><cylinder/></geometry></collision></link><joint"
    )
    car = CART.replace("</link>\n<joint", wheel).replace("<limit><lower>-1</lower><upper>1</upper></limit>", "")
    (tmp_path / "x.sdf").write_text(f"<sdf version='1.7'><world name='w'>{car}</world></sdf>")
    code = (
        "import sys; from trundle.app.cli import main; main(['check', 'x.sdf']);"
        "print(sorted({'mujoco', 'numpy', 'aiohttp', 'PIL'} & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True, timeout=120
    )
    assert done.stdout.splitlines()[-1] == "[]"
    assert physics_accepts(world(car))
    assert "rolls on the ellipsoid inscribed in it, a surface up to 0.1 mm away" in done.stdout


@pytest.mark.slow
def test_published_files_that_pass_the_precheck_compile_without_findings(shared: Path) -> None:
    models = shared / "corpus/repos/osrf+gazebo_models"
    count = 0
    for row in json.loads((shared / "corpus/manifest.json").read_text())["sdf"]:
        path = shared / "corpus" / row["file"]
        packages = Packages({"GAZEBO_MODEL_PATH": str(models)}, start=path)
        try:
            flat = flattened(load(str(path), Diagnostics(), packages=packages).world)
        except TrundleError:
            continue
        if physics_accepts(flat):
            report = Diagnostics()
            compile_world(flat, report)
            assert report.findings == [], path
            count += 1
    assert count > 100


def test_extremely_large_values_fail_the_precheck() -> None:
    assert not physics_accepts(world(CART.replace("<mass>2", "<mass>1e12")))
    axis = world(CART).models[0].joints[0].axis
    assert axis is not None
    assert math.isinf(axis.effort)
