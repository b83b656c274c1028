"""Sweeps whose rows a GPU steps together; without one Warp's CPU device stands for it."""

import re
import subprocess
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import pytest
from tests.warp_device import warp_device

import trundle
from trundle.base.diagnostics import DescriptionError, TrundleError, UsageError
from trundle.sim.physics import NoGpuError
from trundle.studies.sweep.device import batches, device_choice
from trundle.studies.sweep.device.row_check import check_worlds
from trundle.studies.sweep.plan_reader import load_plan
from trundle.studies.sweep.row_runner import RowRunner
from trundle.studies.sweep.rows import Rows

pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
needs_warp = pytest.mark.skipif(
    find_spec("warp") is None or find_spec("mujoco_warp") is None,
    reason="mujoco-warp is not installed: trundle doctor says how",
)
INERTIA = "<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>"
WORLD = f"""<sdf version="1.6"><world name="w"><gravity>0 0 -9.8</gravity>
<model name="floor"><static>1</static><link name="l"><collision name="c">
<geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
<model name="ball"><pose>0 0 0.1 0 0 0</pose><link name="l"><inertial><mass>1</mass>{INERTIA}</inertial>
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model>
<model name="arm"><pose>0 2 1 0 0 0</pose><link name="rod"><pose>0.3 0 0 0 0 0</pose>
<inertial><mass>1</mass>{INERTIA}</inertial></link>
<joint name="hinge" type="revolute"><parent>world</parent><child>rod</child><pose>-0.3 0 0 0 0 0</pose>
<axis><xyz>0 1 0</xyz><dynamics><damping>0.1</damping></dynamics></axis></joint></model>
</world></sdf>"""
PLAN = """\
world: ball.sdf
duration: 1.5
samples: 4
vary:
  models/ball/links/l/inertial/mass: {uniform: [0.5, 2]}
  models/ball/pose/x: {uniform: [-0.2, 0.2]}
  models/arm/joints/hinge/axis/damping: {uniform: [0.05, 0.5]}
  gravity/z: {uniform: [-9.8, -4]}
  push: {uniform: [4, 12]}
  mu: [0.05, 1]
set: {models/ball/links/l/collisions/c/friction: mu}
events:
  - {at: push / 100, push: ball/l, force: [push, 0, 0], for: 0.3}
  - {at: 0.9, joint: arm/hinge, velocity: 1}
every: 0.05
stop: [models.ball.x > 1.5]
measure:
  x: models.ball.x
  turned: models.ball.links.l.pitch
  fastest: {max: models.ball.vx}
  lowest: {max: models.arm.joints.hinge.position}
  angle: models.arm.joints.hinge.position
  moved_at: {time: models.ball.speed > 0.1}
pass: [x < 1.5]
"""


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    (tmp_path / "ball.sdf").write_text(WORLD)
    (tmp_path / "plan.yaml").write_text(PLAN)
    (tmp_path / "f.py").write_text("def f(sim):\n    return 1\n")
    return tmp_path / "plan.yaml"


@pytest.fixture
def stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let Warp's CPU device stand for a GPU where there is none."""
    monkeypatch.setattr(device_choice, "find_gpu", warp_device)


@needs_warp
@pytest.mark.slow
@pytest.mark.usefixtures("stand_in")
def test_rows_come_out_as_on_the_processors(plan: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(batches, "_TOGETHER", 5)
    gpu = trundle.sweep(plan, device="cuda", output=plan.with_name("gpu")).table
    cpu = trundle.sweep(plan, workers=1, output=plan.with_name("cpu")).table

    assert gpu.schema == cpu.schema
    assert gpu.num_rows == 8
    assert {"ok", "failed"} == set(gpu["status"].to_pylist())
    for on_gpu, on_cpu in zip(gpu.to_pylist(), cpu.to_pylist(), strict=True):
        # A ball that begins to slide hops on a GPU, and while it is in the air no friction holds it back.
        assert on_gpu.pop("fastest") == pytest.approx(on_cpu.pop("fastest"), rel=0.01)
        measured = {name: on_cpu.pop(name) for name in ("x", "turned", "lowest", "angle", "moved_at")}
        assert {name: on_gpu.pop(name) for name in measured} == pytest.approx(measured, abs=2e-3)
        del on_gpu["reason"], on_cpu["reason"]  # with six digits of x
        assert on_gpu == on_cpu


@needs_warp
@pytest.mark.slow
@pytest.mark.usefixtures("stand_in")
def test_a_killed_sweep_goes_on_and_its_table_is_the_same(plan: Path) -> None:
    whole = trundle.sweep(plan, device="cuda", output=plan.with_name("whole"))

    _kill_after_a_row(plan)
    again = trundle.sweep(plan, device="cuda")

    assert again.counts == whole.counts
    tables = [folder / "results.parquet" for folder in (whole.folder, again.folder)]
    assert tables[0].read_bytes() == tables[1].read_bytes()
    with pytest.raises(UsageError, match=r"plan\.sweep has rows that ran on 'cuda'; give another folder with -o"):
        trundle.sweep(plan)


def _kill_after_a_row(plan: Path) -> None:
    program = (
        "import sys, trundle\nfrom trundle.studies.sweep.device import device_choice\n"
        f"device_choice.find_gpu = lambda: {warp_device()!r}\n"
        "trundle.sweep(sys.argv[1], device='cuda')"
    )
    journal = plan.with_suffix(".sweep") / "journal.jsonl"
    process = subprocess.Popen([sys.executable, "-c", program, plan], stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 300
    while process.poll() is None and time.monotonic() < deadline:
        if journal.exists() and journal.read_bytes().count(b"\n"):
            break
        time.sleep(0.005)
    process.kill()
    process.wait()
    assert 0 < journal.read_bytes().count(b"\n") < 8


@needs_warp
@pytest.mark.slow
@pytest.mark.usefixtures("stand_in")
def test_a_row_that_cannot_continue_is_an_error_and_the_others_continue(plan: Path) -> None:
    plan.write_text(
        "world: ball.sdf\nduration: 0.2\nsamples: 5\ndesign: latin_hypercube\nvary: {v: {uniform: [0, 1]}}\n"
        "set: {models/ball/links/l/collisions/c/friction: 0.5 if v < 0.4 or v > 0.6 else 0}\n"
        "events: [{at: 0.1, push: ball/l, force: [0, 0, 1e12 if v > 0.8 else 1], for: 0.1}]\n"
    )

    rows = trundle.sweep(plan, device="cuda").table.to_pylist()

    for row in rows:
        if row["v"] > 0.8:
            assert (row["status"], row["time"]) == ("error", pytest.approx(0.1))
            assert row["reason"].startswith("the physics became unstable between 0.1 and 0.2 s; ")
        elif 0.4 <= row["v"] <= 0.6:
            assert row["status"] == "error"
            assert row["reason"].startswith("a GPU cannot step this run beside the first, because the worlds differ in")
        else:
            assert (row["status"], row["reason"]) == ("ok", "")
    assert [row["status"] for row in rows].count("error") == 2


@needs_warp
@pytest.mark.slow
@pytest.mark.usefixtures("stand_in")
def test_a_row_too_crowded_for_the_gpu_says_so_and_the_others_go_on(
    plan: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from trundle.sim.physics.step.warp import stepper

    monkeypatch.setattr(stepper, "_MOST_CONTACTS", 0)  # one box on the floor has room, four have not
    boxes = WORLD.replace("<sphere><radius>0.1</radius></sphere>", "<box><size>0.2 0.2 0.2</size></box>")
    link = re.search(r'<link name="l"><inertial>.*?</link>', boxes, re.DOTALL)
    assert link is not None
    links = "".join(link[0].replace('"l">', f'"{y}"><pose>0 {y} 0 0 0 0</pose>') for y in (1, 3, 4))
    second = f'<model name="second">{links}</model>'
    plan.with_name("boxes.sdf").write_text(boxes.replace("</world>", f"{second}</world>"))
    plan.write_text(
        "world: boxes.sdf\nduration: 0.2\nvary: {height: [2, 0.1001, 3]}\nset: {models/second/pose/z: height}\n"
        "measure: {z: models.second.z}\n"
    )

    rows = trundle.sweep(plan, device="cuda").table.to_pylist()

    assert [row["status"] for row in rows] == ["ok", "error", "ok"]
    assert rows[1]["reason"].startswith("it has more contacts than the GPU has room for between 0 and 0.2 s; ")
    assert [row["z"] for row in rows[::2]] == pytest.approx([2 - 0.5 * 9.8 * 0.2**2, 3 - 0.5 * 9.8 * 0.2**2], abs=0.01)


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("bag: 5", "a sweep on a GPU has no bags; leave out `bag` or the device"),
        ("plugins: true", "a sweep on a GPU has no plugins; leave out `plugins` or the device"),
        ("time_limit: 5", "a sweep on a GPU has no limits of single runs; leave out `time_limit` or the device"),
        ("measure: {a: {function: 'f.py:f'}}", "a sweep on a GPU calls no Python functions; measure 'a' by an"),
        ("measure: {a: 'topics[\"/clock\"].clock.sec'}", "a sweep on a GPU has no topics; leave out `topics` or the"),
        ("stop: models.arm.joints.hinge.effort > 1", "a sweep on a GPU has no efforts of joints; leave out `effort`"),
        ("vary: {models/a/links/b/sensors/c/update_rate: [1, 2]}", "models/a/links/b/sensors/c/update_rate: a sweep"),
    ],
)
def test_features_that_the_gpu_lacks_are_reported_with_their_line(plan: Path, line: str, sentence: str) -> None:
    plan.write_text(f"world: ball.sdf\nduration: 1\n{line}\n")

    with pytest.raises(DescriptionError) as error:
        trundle.sweep(plan, device="cuda")

    assert str(error.value).startswith(f"{plan}:3: error: {sentence}")
    assert not plan.with_suffix(".sweep").exists()


def test_a_launch_file_is_refused(plan: Path) -> None:
    plan.write_text("launch: a.launch\nduration: 1\n")

    with pytest.raises(DescriptionError, match=r"plan\.yaml:1: error: a sweep on a GPU has no launch files"):
        trundle.sweep(plan, device="cuda")


@pytest.fixture
def check(plan: Path) -> Callable[[str], str]:
    """Check the worlds of a plan with one more line; return the error."""

    def error_of(line: str) -> str:
        plan.write_text(f"world: ball.sdf\nduration: 1\n{line}\n")
        read = load_plan(plan)
        with pytest.raises(DescriptionError) as error:
            check_worlds(read, Rows(read).row(0), RowRunner(read))
        return str(error.value).removeprefix(f"{plan}:")

    return error_of


def test_quantities_of_another_model_are_refused_with_their_line(check: Callable[[str], str]) -> None:
    apart = "a GPU steps worlds of one compiled model, and the worlds differ in more than numbers: "

    assert check("vary: {time_step: [0.001, 0.002]}").startswith(f"3: error: time_step: {apart}")
    path = "models/floor/pose/z"
    assert check(f"vary:\n  low: [0, -1]\nset:\n  {path}: low").startswith(f"6: error: {path}: {apart}")
    path = "models/ball/links/l/collisions/c/geometry/radius"
    assert check(f"vary: {{{path}: {{uniform: [0.1, 0.2]}}}}").startswith(f"3: error: {path}: {apart}")


def test_masses_and_frictions_of_a_robot_are_numbers_of_its_model(plan: Path) -> None:
    plan.write_text(
        "world: model://rp2w\nduration: 1\n"
        "vary: {models/rp2w/links/chassis/inertial/mass: {uniform: [2, 5]}, mu: {log_uniform: [0.01, 1]}}\n"
        "set: {models/rp2w/links/*/collisions/*/friction: mu}\n"
    )
    read = load_plan(plan)

    check_worlds(read, Rows(read).row(0), RowRunner(read))


def test_a_world_with_a_law_that_a_gpu_lacks_is_refused(check: Callable[[str], str]) -> None:
    found = check("set: {models/ball/links/l/collisions/c/surface/mu2: '0.2'}")

    assert found.startswith("1: error: a GPU cannot step this world: contacts have two different frictions")


def test_without_a_gpu_a_line_says_so_and_the_processors_run_the_rows(
    plan: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def find_none() -> str:
        raise NoGpuError("this machine has no driver of an NVIDIA GPU")

    monkeypatch.setattr(device_choice, "find_gpu", find_none)
    plan.write_text("world: ball.sdf\nduration: 0.1\nmeasure: {x: models.ball.x}\n")

    done = trundle.sweep(plan, device="cuda")

    line = "device='cuda': this machine has no driver of an NVIDIA GPU; the rows are run by the processors\n"
    assert capsys.readouterr().err.startswith(line)
    assert done.counts == {"ok": 1}
    assert trundle.sweep(plan).counts == {"ok": 1}


def test_processes_and_unknown_devices_are_refused(plan: Path) -> None:
    with pytest.raises(TrundleError, match="leave out `workers` and `address`, or `device`"):
        trundle.sweep(plan, device="cuda", workers=2)
    with pytest.raises(TrundleError, match="device='tpu': rows are stepped on 'cpu' or 'cuda'"):
        trundle.sweep(plan, device="tpu")  # pyright: ignore[reportArgumentType]
