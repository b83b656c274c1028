"""Names of `trundle`: what `dir` lists, what tracebacks and reprs print, how wrong arguments and names are refused."""

import importlib.util
import os
import pickle
import subprocess
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trundle

_Pose: Any = trundle.Pose
_Wrench: Any = trundle.Wrench
_HAS_GYM = importlib.util.find_spec("gymnasium") is not None
_ARM = """<sdf version="1.6"><world name="w"><model name="arm"><static>0</static>
  <link name="base"><inertial><mass>1</mass></inertial></link>
  <link name="tip"><pose>0 0 1 0 0 0</pose><inertial><mass>1</mass></inertial>
    <sensor name="lidar" type="ray"><ray><scan><horizontal><samples>5</samples><min_angle>-1</min_angle>
      <max_angle>1</max_angle></horizontal></scan><range><min>0.1</min><max>9</max></range></ray></sensor></link>
  <joint name="elbow" type="revolute"><parent>base</parent><child>tip</child><axis><xyz>0 1 0</xyz></axis></joint>
</model></world></sdf>"""


@pytest.fixture
def sim(tmp_path: Path) -> trundle.LoadedSimulation:
    file = tmp_path / "arm.world"
    file.write_text(_ARM)
    return trundle.load(file)


def _all() -> list[str]:
    return list(getattr(trundle, "__all__"))  # noqa: B009  # the stub has no `__all__`


def test_dir_lists_what_there_is() -> None:
    assert set(dir(trundle)) == {*_all(), "gym", "__version__"}
    assert all(hasattr(trundle, name) for name in dir(trundle) if _HAS_GYM or name != "gym")


def test_classes_are_named_after_trundle_and_not_a_room() -> None:
    classes = [value for name in _all() if isinstance(value := getattr(trundle, name), type)]

    assert len(classes) > 50
    assert [kind for kind in classes if kind.__module__ != "trundle"] == []
    assert all(pickle.loads(pickle.dumps(kind)) is kind for kind in classes)


def test_a_traceback_names_trundle(sim: trundle.LoadedSimulation) -> None:
    with pytest.raises(trundle.TrundleError) as caught:
        sim["leg"]

    assert traceback.format_exception_only(caught.value) == ["trundle.UsageError: no model 'leg'; there are: 'arm'\n"]


def test_an_unknown_name_suggests_a_similar_one() -> None:
    with pytest.raises(AttributeError, match=r"^module 'trundle' has no attribute 'Poze' \(did you mean 'Pose'\?\)$"):
        _ = trundle.Poze  # pyright: ignore


def test_a_name_imports_its_own_module_only() -> None:
    code = "import sys, trundle; trundle.Pose; print({'numpy', 'mujoco', 'lxml', 'trundle.sim'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert done.stdout == "set()\n"


_CALLS: list[tuple[Callable[[trundle.LoadedSimulation], object], str]] = [
    (lambda s: s.run(-1), "duration_s [s] must be a finite number of 0 or more, got -1"),
    (lambda s: s.run("2"), "duration_s [s] must be a finite number of 0 or more, got '2'"),  # pyright: ignore
    (lambda s: s.run(float("inf")), "duration_s [s] must be a finite number of 0 or more, got inf"),
    (lambda s: s.step(-5), "count must be a whole number of 0 or more, got -5"),
    (lambda s: s.step(1.5), "count must be a whole number of 0 or more, got 1.5"),  # pyright: ignore
    (
        lambda s: s["arm"].set_pose((1, 2)),
        "pose must be a Pose, (x, y, z) [m], (x, y, z, roll, pitch, yaw) [m, rad] or (x, y, z, qw, qx, qy, qz), "
        "got (1, 2)",
    ),
    (lambda s: s["arm"].set_pose(np.eye(4)), "got an array of shape (4, 4)"),
    (
        lambda s: s["arm"].set_pose(trundle.Pose((0, 0, 1), (2, 0, 0, 0))),
        "pose: the quaternion (w, x, y, z) must have length 1, got (2.0, 0.0, 0.0, 0.0)",
    ),
    (
        lambda s: s["arm"].set_twist("fast"),
        "twist must be a Twist, or (vx, vy, vz) [m/s], or (vx, vy, vz, wx, wy, wz) [m/s, rad/s], got 'fast'",
    ),
    (
        lambda s: s["arm"].link("tip").apply_wrench(15.0),
        "wrench must be a Wrench, or (fx, fy, fz) [N], or (fx, fy, fz, tx, ty, tz) [N, N·m], got 15.0",
    ),
    (
        lambda s: s["arm"].link("tip").add_wrench((1, 0, 0), at=(1, 2)),
        "at [m] must be 3 finite numbers (x, y, z), got (1, 2)",
    ),
    (lambda s: s["arm"].apply_wrench((1, 0, 0), duration_s=-1), "duration_s [s] must be a finite number of 0 or more"),
    (lambda s: s["arm"].jacobian("tip", 1), "point [m] must be 3 finite numbers (x, y, z), got 1"),
    (
        lambda s: s["arm"].joint("elbow").set_position("up"),  # pyright: ignore
        "position [rad or m] must be a finite number, got 'up'",
    ),
    (
        lambda s: s["arm"].joint("elbow").command_position(0.1, max_effort=-1),
        "max_effort [N·m or N] must be a finite number of 0 or more, got -1",
    ),
    (
        lambda s: s["arm"].joint("elbow").command_effort(float("nan")),
        "effort [N·m or N] must be a finite number, got nan",
    ),
    (
        lambda s: setattr(s["arm"], "joint_positions", "up"),
        "model 'arm': joint_positions is no array of numbers: 'up'; its shape is (1,): joints: 'elbow'",
    ),
    (lambda s: s["arms"], "no model 'arms' (did you mean 'arm'?); there are: 'arm'"),
    (lambda s: s["arm"].link("top"), "model 'arm' has no link 'top'; there are: 'base', 'tip'"),
    (lambda s: s["arm"].joint("elbw"), "model 'arm' has no joint 'elbw' (did you mean 'elbow'?); there are: 'elbow'"),
    (lambda s: s.sensor("lidr"), "no sensor 'lidr' (did you mean 'lidar'?); there are: 'arm::tip::lidar'"),
    (lambda s: s.camera("eye"), "no camera 'eye'; there are: none"),
    (lambda _: trundle.load(3), "load needs a file's path, model://NAME, a Model or a World, got 3"),  # pyright: ignore
]


@pytest.mark.parametrize(("call", "message"), _CALLS, ids=[message[:40] for _, message in _CALLS])
def test_wrong_arguments_are_refused_in_a_sentence(
    sim: trundle.LoadedSimulation, call: Callable[[trundle.LoadedSimulation], object], message: str
) -> None:
    with pytest.raises(trundle.UsageError) as caught:
        call(sim)

    assert message in str(caught.value)
    assert sim.time_ns == 0


@pytest.mark.parametrize("make", [lambda: _Pose((0, 0, 1), (0, 0, 1)), lambda: _Pose(1), lambda: _Wrench("up")])
def test_values_of_another_shape_are_refused(make: Callable[[], object]) -> None:
    with pytest.raises(ValueError, match=r"^a (Pose|Wrench)'s .* must (be|have) [34] numbers"):
        make()


def test_tuples_lists_and_arrays_are_poses_twists_and_wrenches(sim: trundle.LoadedSimulation) -> None:
    arm = sim["arm"]

    for pose in ((1, 2, 3), [1, 2, 3, 0, 0, 0], np.array([1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0]), _Pose([1, 2, 3])):
        arm.set_pose((0, 0, 0))
        arm.set_pose(pose)
        assert arm.pose == trundle.Pose((1.0, 2.0, 3.0))
    arm.set_twist((0, 0, 0, 0, 0, 1))
    assert arm.twist.angular == (0.0, 0.0, 1.0)
    arm.set_twist(np.array([1, 0, 0]))
    assert arm.twist == trundle.Twist((1.0, 0.0, 0.0))
    arm.apply_wrench([0, 15, 0], duration_s=1)
    assert arm.base.applied_wrench == (trundle.Wrench((0.0, 15.0, 0.0)), 1.0)
    assert _Wrench(np.array([0, 15, 0])) == trundle.Wrench((0.0, 15.0, 0.0))


def test_a_scan_has_its_angles(sim: trundle.LoadedSimulation) -> None:
    reading = sim.sensor("lidar").read()

    assert isinstance(reading, trundle.RangeReading)
    assert reading.horizontal_angles.tolist() == [-1.0, -0.5, 0.0, 0.5, 1.0]
    assert reading.vertical_angles.shape == (reading.ranges.shape[0],)


def test_findings_are_printed_as_warnings_with_file_and_line(tmp_path: Path) -> None:
    file = tmp_path / "m.world"
    file.write_text(_ARM.replace("<static>0", "\n<surprise>1</surprise><static>0"))
    code = f"import trundle; sim = trundle.load({str(file)!r}); print(len(sim.report.warnings))"
    quiet = code.replace("')", "', warn=False)")

    printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    silent = subprocess.run([sys.executable, "-c", quiet], capture_output=True, text=True, check=True)
    off = {**os.environ, "PYTHONWARNINGS": "ignore"}
    filtered = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=off)

    assert printed.stderr.splitlines()[0].startswith(f"{file}:2: TrundleWarning: ")
    assert "surprise" in printed.stderr
    assert printed.stdout == silent.stdout == filtered.stdout == "1\n"
    assert silent.stderr == filtered.stderr == ""
