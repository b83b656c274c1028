"""A model plugin in C++ that sets two wheels' speeds at every step, against the same wheels without a plugin.

Times are CPU times of this process, which vary least with other programs' load.
"""

import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import trundle
from bench.table import Row
from trundle.gazebo.model_plugins import load_plugins
from trundle.sim.simulation import Simulation

_ROOT = Path(__file__).parents[1]
_STEPS = 20_000
_PAIRS = 7
_WHEELS = ("chassis_left_wheel", "chassis_right_wheel")


def run() -> list[Row]:
    """Compile the plugin, and alternate both simulations."""
    with TemporaryDirectory() as folder:
        library = _compile(Path(folder))
        return [_row({"GAZEBO_PLUGIN_PATH": str(library)})]


def _compile(folder: Path) -> Path:
    shutil.copytree(_ROOT / "tests/data/gazebo_plugins/drive", folder, dirs_exist_ok=True)
    build = f"cmake -S '{folder}' -B '{folder}/build' -DCMAKE_BUILD_TYPE=Release && cmake --build '{folder}/build'"
    subprocess.run([sys.executable, "-m", "trundle", "shell", "-c", build], check=True, capture_output=True)
    return folder / "build"


def _row(environment: dict[str, str]) -> Row:
    plugged, bare = (trundle.load(str(_ROOT / "examples/rp2w"), plugins=False, ros=False) for _ in range(2))
    if not load_plugins(plugged, None, environment, log=lambda _: None):
        raise RuntimeError(f"the plugin is not loaded: {plugged.report.warnings}")
    for name in _WHEELS:
        bare["rp2w"].joint(name).command_velocity(2.0, max_effort=2.0)
    for sim in (plugged, bare):
        sim.run(1.0)
    pairs = [(_rate(plugged), _rate(bare)) for _ in range(_PAIRS)]
    value, ratio = statistics.median(a for a, _ in pairs), statistics.median(a / b for a, b in pairs)
    return Row("RP2W with a C++ plugin at every step", value, "steps/s", "its wheels driven without a plugin", ratio)


def _rate(sim: Simulation) -> float:
    start = time.process_time()
    sim.step(_STEPS)
    return _STEPS / (time.process_time() - start)
