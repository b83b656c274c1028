"""A world's plugin in C++ that asks for models, gravity and motions, in the ways of Gazebo's tutorials."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from trundle.base.diagnostics import UsageError
from trundle.ros.sdk import find_toolchain

pytestmark = pytest.mark.slow
_SOURCE = Path(__file__).parents[3] / "data/gazebo_plugins/stage"
_WAIT_S = 1800  # the first to come compiles the kit


def _run(*words: str, cwd: Path, **variables: str) -> str:
    path = os.pathsep.join([sysconfig.get_path("scripts"), os.environ["PATH"]])
    left_out = ("GAZEBO_PLUGIN_PATH", "CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "ROS_MASTER_URI")
    kept = {name: value for name, value in os.environ.items() if name not in left_out}
    done = subprocess.run(
        [sys.executable, "-m", "trundle", *words],
        cwd=cwd,
        env={**kept, "PATH": path, "PWD": str(cwd), **variables},
        capture_output=True,
        text=True,
        check=False,
        timeout=_WAIT_S,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


def _crate(models: Path, name: str) -> None:
    (models / name).mkdir(parents=True)
    box = "<geometry><box><size>.2 .2 .2</size></box></geometry>"
    (models / name / "model.sdf").write_text(
        f"<sdf version='1.6'><model name='{name}'><pose>3 0 9 0 0 0</pose><link name='link'><collision name='c'>{box}"
        "</collision></link></model></sdf>"
    )
    (models / name / "model.config").write_text(
        f"<model><name>{name}</name><version>1</version><sdf version='1.6'>model.sdf</sdf></model>"
    )


def test_a_world_plugin_sets_a_stage(tmp_path: Path) -> None:
    """Four models come before the first step and fall by 1.6 m/s² · (1 s)² / 2; a spline and a line are half way."""
    try:
        find_toolchain(os.environ)
    except UsageError as error:
        pytest.skip(str(error))
    folder, models = tmp_path / "stage", tmp_path / "models"
    shutil.copytree(_SOURCE, folder)
    for name in ("crate", "crate2"):
        _crate(models, name)
    _run("shell", "-c", "cmake -S . -B build && cmake --build build", cwd=folder)

    words = ("run", "stage.world", "--headless", "--no-ros", "--duration", "2.2", "--speed", "max")
    output = _run(*words, cwd=folder, GAZEBO_MODEL_PATH=str(models), GAZEBO_PLUGIN_PATH=str(folder / "build"))

    lines = output.splitlines()
    for expected in (
        "model lift at 0.00 3.00 2.00",
        "model door at 0.00 -3.00 1.00",
        "model text at 1.00 0.00 8.20",
        "model document at 2.00 0.00 8.20",
        "model crate at 3.00 0.00 8.20",
        "model crate2 at 4.00 5.00 5.20",
        "hinge at 0.500, 6 models by ~/world_stats",
        "the lift's box is 1.00 2.00 0.50",
    ):
        assert expected in lines, output
    assert sum("the lift is up" in line for line in lines) == 1, output
    x, y = np.meshgrid(np.arange(200), np.arange(200))
    np.testing.assert_array_equal(np.asarray(Image.open(folder / "frame.png")), np.dstack((x, y, x ^ y)))


def test_a_world_plugin_changes_surfaces_and_sends_messages_of_its_own(tmp_path: Path) -> None:
    """From 0.5 s on a box slides down a slope of 0.3 rad; another falls through it; messages come from .proto files."""
    try:
        find_toolchain(os.environ)
    except UsageError as error:
        pytest.skip(str(error))
    folder = tmp_path / "slide"
    shutil.copytree(_SOURCE.with_name("slide"), folder)
    _run("shell", "-c", "cmake -S . -B build && cmake --build build", cwd=folder)

    words = ("run", "slide.world", "--headless", "--no-ros", "--duration", "2.1", "--speed", "max")
    output = _run(*words, cwd=folder, GAZEBO_PLUGIN_PATH=str(folder / "build"))

    number = r" (-?[\d.e-]+)"
    report = rf"at \d s in world, last 10: keeps{number}{number} slips{number}{number} ghost{number}{number}"
    places = np.array(re.findall(report, output), dtype=float).reshape(-1, 3, 2)
    assert len(places) == 2, output
    slid = 0.5 * 9.8 * np.sin(0.3) * 1.5**2
    keeps, slips, ghost = (places[1] - places[0]).round(3)
    assert np.abs(keeps).max() < 0.01
    np.testing.assert_allclose(slips, [slid * np.cos(0.3), -slid * np.sin(0.3)], rtol=0.02)
    np.testing.assert_allclose(ghost, [0.0, -0.5 * 9.8 * (2.0**2 - 0.499**2)], rtol=0.01, atol=0.01)
