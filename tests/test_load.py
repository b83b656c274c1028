"""The public API with the published robot, and imports at the start."""

import subprocess
import sys
from pathlib import Path

import pytest

import trundle
from trundle.spatial import Wrench


@pytest.mark.parametrize(("force", "distance", "within"), [(15.0, 0.412, 0.412 * 0.02), (5.0, 0.0, 0.001)])
def test_a_force_above_friction_rolls_the_robot(shared: Path, force: float, distance: float, within: float) -> None:
    """Rigid rolling of 6 kg with three wheels of 1 kg·m² against 0.3 N·m of friction in two: 0.4117 m for 15 N in
    10 s; 5 N do not overcome the friction (2 · 0.3 N·m / 0.0635 m = 9.4 N).
    """
    sim = trundle.load(str(shared / "seeds/rp2w/model.sdf"))
    chassis = sim["my_robot"].link("chassis")
    start = chassis.pose.position[1]

    chassis.apply_wrench(Wrench(force=(0.0, force, 0.0)), duration_s=10.0)
    sim.run(10.0)

    assert chassis.pose.position[1] - start == pytest.approx(distance, abs=within)


def test_importing_trundle_imports_no_heavy_modules() -> None:
    """Light commands must start fast."""
    heavy = {"numpy", "mujoco", "aiohttp", "lxml"}
    code = f"import sys, trundle, trundle.app.cli; print(*sorted({heavy} & set(sys.modules)))"

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert done.stdout.strip() == ""


def test_xacro_loads_no_parser_of_descriptions(tmp_path: Path) -> None:
    """ROS' own xacro needs nothing but minidom and PyYAML."""
    others = {"dataclasses", "lxml", "msgspec", "tempfile", "trundle.robots.packages.configured_files"}
    file = tmp_path / "robot.xacro"
    file.write_text('<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><a b="${1 + 1} $(optenv R x)"/></robot>')
    code = "import sys; from trundle.app.cli import main; main(); "
    code += f"print(*sorted({others} & set(sys.modules)), file=sys.stderr)"

    done = subprocess.run([sys.executable, "-c", code, "xacro", file], capture_output=True, text=True, check=True)

    assert '<a b="2 x"/>' in done.stdout
    assert done.stderr.strip() == ""


def test_the_entry_point_imports_nothing_before_it_handles_sigint() -> None:
    """Ctrl-C while modules load would print Python's traceback."""
    code = (
        "import sys, trundle; had = set(sys.modules); import trundle.__main__; print(*sorted(set(sys.modules) - had))"
    )

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert done.stdout.split() == ["trundle.__main__"]


def test_a_robot_imports_only_modules_that_it_needs() -> None:
    """RP2W has cameras; modules and dataclasses of other sensors would slow every start."""
    words = ["run", "model://rp2w", "--headless", "--no-ros", "--duration", "0.001"]
    others = {
        "numpy.random",
        "secrets",
        "trundle.base.http.access",
        "trundle.robots.meshes.load",
        "trundle.robots.model.actor",
        "trundle.robots.model.instrument",
        "trundle.robots.model.measuring",
        "trundle.sim.physics.convex.mesh_decomposition",
        "trundle.sim.physics.step.surface_motion",
        "trundle.sim.render.actor_skins",
        "trundle.sim.sensors.cameras.depth",
        "trundle.sim.sensors.imu",
        "trundle.sim.sensors.mount_instruments",
        "trundle.sim.simulation.state_log",
    }
    loaded = f"print(*sorted({others} & set(sys.modules)), file=sys.stderr)"
    code = f"import sys, trundle.app.cli as c; c.main({words}); {loaded}"

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert done.stderr.splitlines()[-1] == ""


def test_the_start_of_the_simulator_creates_no_dataclasses() -> None:
    """Each takes half a millisecond; RP2W used to load 110."""
    words = ["run", "model://rp2w", "--headless", "--no-ros", "--duration", "0.001"]
    rooms = ["spatial", "model", "meshes", "description", "physics", "render", "simulation", "sensors", "control"]
    code = (
        f"import dataclasses, sys, trundle.app.cli as c; c.main({words});"
        f"modules = [m for name, m in sys.modules.items() if name.split('.')[:1] == ['trundle']"
        f" and name.split('.')[1:2] and name.split('.')[1] in {rooms}];"
        "classes = {c for m in modules for c in vars(m).values() if dataclasses.is_dataclass(c)};"
        "print(*sorted(c.__qualname__ for c in classes if isinstance(c, type)), file=sys.stderr)"
    )

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert done.stderr.splitlines()[-1] == ""
