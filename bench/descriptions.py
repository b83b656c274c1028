"""How fast descriptions are read, against the tools that people have."""

import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path

from bench.table import Row
from trundle.description import load
from trundle.diagnostics import Diagnostics, TrundleError
from trundle.packages import Packages

SHARED = Path(__file__).parents[2] / "shared"
MODELS = SHARED / "corpus/repos/osrf+gazebo_models"
_RUNS = 5


def run() -> list[Row]:
    """Ours and theirs by turns in one run; a peer that is not installed is left out."""
    if not MODELS.is_dir():
        return []
    return [_sdf(), _urdf()]


def _sdf() -> Row:
    """Every SDF of the model database, read and resolved."""
    files = sorted(MODELS.rglob("*.sdf"))
    packages = Packages({"GAZEBO_MODEL_PATH": str(MODELS)}, start=MODELS)
    with tempfile.TemporaryDirectory() as folder:
        peer = _sdformat(Path(folder), files)
        ours, ratio = _by_turns(lambda: _read(files, packages), peer)
    return Row("SDF, model database", len(files) / ours, "files/s", "libsdformat", ratio)


def _urdf() -> Row:
    """Every URDF of the collection that needs no expansion; both resolve where every link is."""
    found = sorted((SHARED / "corpus/repos").rglob("*.urdf"))
    files = [file for file in found if "xacro" not in file.read_text(errors="replace")]

    def peer() -> float:
        from yourdfpy import URDF  # pyright: ignore

        start = time.perf_counter()
        for file in files:
            with suppress(Exception):
                URDF.load(str(file), load_meshes=False)  # pyright: ignore
        return time.perf_counter() - start

    packages = Packages({}, start=SHARED)
    ours, ratio = _by_turns(lambda: _read(files, packages), peer if find_spec("yourdfpy") else None)
    return Row("URDF, read and converted", len(files) / ours, "files/s", "yourdfpy", ratio)


def _read(files: list[Path], packages: Packages) -> float:
    start = time.perf_counter()
    for file in files:
        with suppress(TrundleError):
            load(str(file), Diagnostics(), packages=packages)
    return time.perf_counter() - start


def _sdformat(folder: Path, files: list[Path]) -> Callable[[], float] | None:
    """A small reader built on Debian's libsdformat-dev; None where that is not there."""
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", "sdformat12"], capture_output=True, text=True, check=False
    )
    if flags.returncode != 0:
        return None
    reader, source = folder / "reader", Path(__file__).parent / "sdformat_reader.cc"
    subprocess.run(["c++", "-O2", "-std=c++17", str(source), "-o", str(reader), *flags.stdout.split()], check=True)
    names = "\n".join(map(str, files))

    def peer() -> float:
        done = subprocess.run([str(reader), str(MODELS)], input=names, capture_output=True, text=True, check=True)
        return float(done.stdout.split()[-1])

    return peer


def _by_turns(ours: Callable[[], float], theirs: Callable[[], float] | None) -> tuple[float, float | None]:
    """Our median time, and the median of theirs over ours, pair by pair: how many times faster ours is."""
    mine: list[float] = []
    ratios: list[float] = []
    for _ in range(_RUNS):
        mine.append(ours())
        if theirs is not None:
            ratios.append(theirs() / mine[-1])
    return statistics.median(mine), statistics.median(ratios) if ratios else None
