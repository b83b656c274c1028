"""CPU time of reading descriptions, one process each, against other readers."""

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
_TURNS = 4
_OF_THE_MODELS = 6
"""The peer reads every sixth file of the database: all of them take it half a minute."""

Reader: TypeAlias = Callable[[Sequence[Path]], float]
"""Reads files; returns the CPU time [s]."""


def run() -> list[Row]:
    """Measure readers in alternation; a peer that cannot be installed is left out."""
    if not MODELS.is_dir():
        return []
    with tempfile.TemporaryDirectory() as name:
        return [_sdf(Path(name)), _urdf(Path(name))]


def _sdf(folder: Path) -> Row:
    """Every SDF of the model database, read and resolved."""
    files = sorted(MODELS.rglob("*.sdf"))
    ours = _ours(Packages({"GAZEBO_MODEL_PATH": str(MODELS)}, start=MODELS))
    shares = [files[turn :: _OF_THE_MODELS * _TURNS] for turn in range(_TURNS)]
    ratio = _by_turns(ours, _sdformat(folder), shares)
    return Row("SDF, model database", len(files) / ours(files), "files/s", "libsdformat 12, every 6th file", ratio)


def _urdf(folder: Path) -> Row:
    """Every URDF of the collection that needs no expansion; both compute the pose of every link.

    yourdfpy reads less: links, joints and materials, but no sensors, plugins and surfaces of <gazebo> and no
    <transmission>; it looks for no files, and names nothing that it does not know.
    """
    found = sorted((SHARED / "corpus/repos").rglob("*.urdf"))
    files = [file for file in found if "xacro" not in file.read_text(errors="replace")]
    ours = _ours(Packages({}, start=SHARED))
    ratio = _by_turns(ours, _yourdfpy(folder), [files] * _TURNS)
    peer = "yourdfpy, which reads no <gazebo> and no <transmission>"
    return Row("URDF, read and converted", len(files) / ours(files), "files/s", peer, ratio)


def _ours(packages: Packages) -> Reader:
    def read(files: Sequence[Path]) -> float:
        start = time.process_time()
        for file in files:
            with suppress(TrundleError):
                load(str(file), Diagnostics(), packages=packages)
        return time.process_time() - start

    return read


def _sdformat(folder: Path) -> Reader | None:
    """A small reader built on Debian's libsdformat-dev; None where that is not there."""
    flags = ["pkg-config", "--cflags", "--libs", "sdformat12"]
    found = subprocess.run(flags, capture_output=True, text=True, check=False)
    if found.returncode != 0:
        return None
    reader = folder / "reader"
    source = str(_HERE / "sdformat_reader.cc")
    subprocess.run(["c++", "-std=c++17", source, "-o", str(reader), *found.stdout.split()], check=True)
    return _program([str(reader), str(MODELS)], {})


def _yourdfpy(folder: Path) -> Reader | None:
    """Reader by yourdfpy, installed for the run on top of Trundle's own environment."""
    install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--target", str(folder)]
    done = subprocess.run([sys.executable, *install, "yourdfpy==0.0.60", "six"], capture_output=True, check=False)
    if done.returncode != 0:
        return None
    return _program([sys.executable, str(_HERE / "yourdfpy_reader.py")], {"PYTHONPATH": str(folder)})


def _program(command: list[str], variables: dict[str, str]) -> Reader:
    """Reader that runs a program on the files' names and reads the time from its output."""

    def read(files: Sequence[Path]) -> float:
        names = "\n".join(map(str, files))
        env = {**os.environ, **variables}
        done = subprocess.run(command, input=names, env=env, capture_output=True, text=True, check=True)
        return float(done.stdout.split()[-1])

    return read


def _by_turns(ours: Reader, theirs: Reader | None, shares: Sequence[Sequence[Path]]) -> float | None:
    """Median over shares of their time over ours."""
    ours(shares[0])  # loads what is loaded on first use
    return None if theirs is None else statistics.median(theirs(share) / ours(share) for share in shares)
