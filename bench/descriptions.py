"""CPU time of reading descriptions, in one process for each reader, against other readers."""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TypeAlias

from bench.table import Row
from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.robots.description import load
from trundle.robots.packages import Packages

SHARED = Path(__file__).parents[2] / "shared"
MODELS = SHARED / "corpus/repos/osrf+gazebo_models"
_HERE = Path(__file__).parent
_PARTS = 4
_FILE_STRIDE = 6
"""The peer reads every sixth file of the database, as it takes half a minute for all files."""

Reader: TypeAlias = Callable[[Sequence[Path]], float]
"""Reads files; returns the CPU time [s]."""


def run() -> list[Row]:
    """Measure readers in alternation; skip a peer that cannot be installed."""
    if not MODELS.is_dir():
        return []
    with tempfile.TemporaryDirectory() as name:
        return [_sdf(Path(name)), _urdf(Path(name))]


def _sdf(folder: Path) -> Row:
    """Every SDF of the model database, read and resolved."""
    files = sorted(MODELS.rglob("*.sdf"))
    read = _trundle_reader(Packages({"GAZEBO_MODEL_PATH": str(MODELS)}, start=MODELS))
    parts = [files[part :: _FILE_STRIDE * _PARTS] for part in range(_PARTS)]
    ratio = _time_ratio(read, _sdformat(folder), parts)
    return Row("SDF, model database", len(files) / read(files), "files/s", "libsdformat 12, every 6th file", ratio)


def _urdf(folder: Path) -> Row:
    """Every URDF of the collection without xacro; both readers compute the pose of every link.

    yourdfpy reads links, joints and materials, but no <gazebo> with sensors, plugins and surfaces, and no
    <transmission>; it searches no files and reports no unknown elements.
    """
    paths = sorted((SHARED / "corpus/repos").rglob("*.urdf"))
    files = [file for file in paths if "xacro" not in file.read_text(errors="replace")]
    read = _trundle_reader(Packages({}, start=SHARED))
    ratio = _time_ratio(read, _yourdfpy(folder), [files] * _PARTS)
    peer = "yourdfpy, which reads no <gazebo> and no <transmission>"
    return Row("URDF, read and converted", len(files) / read(files), "files/s", peer, ratio)


def _trundle_reader(packages: Packages) -> Reader:
    def read(files: Sequence[Path]) -> float:
        start = time.process_time()
        for file in files:
            with suppress(TrundleError):
                load(str(file), Diagnostics(), packages=packages)
        return time.process_time() - start

    return read


def _sdformat(folder: Path) -> Reader | None:
    """Build a small reader on Debian's libsdformat-dev; return None if it is not installed."""
    flags = ["pkg-config", "--cflags", "--libs", "sdformat12"]
    compiler_flags = subprocess.run(flags, capture_output=True, text=True, check=False)
    if compiler_flags.returncode != 0:
        return None
    reader = folder / "reader"
    source = str(_HERE / "sdformat_reader.cc")
    subprocess.run(["c++", "-std=c++17", source, "-o", str(reader), *compiler_flags.stdout.split()], check=True)
    return _program([str(reader), str(MODELS)], {})


def _yourdfpy(folder: Path) -> Reader | None:
    """Install yourdfpy for the run in addition to Trundle's environment; return its reader, or None."""
    install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--target", str(folder)]
    process = subprocess.run([sys.executable, *install, "yourdfpy==0.0.60", "six"], capture_output=True, check=False)
    if process.returncode != 0:
        return None
    return _program([sys.executable, str(_HERE / "yourdfpy_reader.py")], {"PYTHONPATH": str(folder)})


def _program(command: list[str], variables: dict[str, str]) -> Reader:
    """Return a reader that runs a program with the files' names and reads the time from its output."""

    def read(files: Sequence[Path]) -> float:
        names = "\n".join(map(str, files))
        env = {**os.environ, **variables}
        process = subprocess.run(command, input=names, env=env, capture_output=True, text=True, check=True)
        return float(process.stdout.split()[-1])

    return read


def _time_ratio(read: Reader, peer: Reader | None, parts: Sequence[Sequence[Path]]) -> float | None:
    """Return the median over parts of the peer's time over Trundle's."""
    read(parts[0])  # warms up
    return None if peer is None else statistics.median(peer(part) / read(part) for part in parts)
