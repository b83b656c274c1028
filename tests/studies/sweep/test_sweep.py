"""Sweeps by the whole path: plan, processes, table."""

import base64
import io
import os
import re
import secrets
import signal
import subprocess
import sys
import time
from pathlib import Path
from random import Random
from xml.etree import ElementTree

import pytest
from PIL import Image

import trundle
from trundle.base.diagnostics import TrundleError
from trundle.studies.sweep.plan_reader import load_plan
from trundle.studies.sweep.row_runner import RowRunner
from trundle.studies.sweep.rows import Rows

pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
TRUNDLE = Path(sys.executable).with_name("trundle")
WORLD = """<sdf version="1.6"><world name="w"><gravity>0 0 -9.8</gravity>
<model name="floor"><static>1</static><link name="l"><collision name="c">
<geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
<model name="box"><pose>0 0 0.1 0 0 0</pose><link name="link"><inertial><mass>1</mass><inertia>
<ixx>0.007</ixx><iyy>0.007</iyy><izz>0.007</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
<collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model>
</world></sdf>"""
PLAN = """\
world: box.sdf
duration: 1
samples: 8
vary:
  models/box/links/link/inertial/mass: {uniform: [0.5, 2]}
  mu: [0.1, 0.5, 1]
set: {models/box/links/link/collisions/c/friction: mu}
events: [{at: 0.2, push: box/link, force: [10, 0, 0], for: 0.3}]
every: 0.05
measure:
  x: models.box.x
  fastest: {max: models.box.speed}
  moved_at: {time: models.box.x > 0.01}
  mass: {function: box.py:mass}
pass: [x < 0.8]
"""


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    (tmp_path / "box.sdf").write_text(WORLD)
    (tmp_path / "box.py").write_text("def mass(sim):\n    return sim['box'].link('link').link.inertial.mass\n")
    (tmp_path / "plan.yaml").write_text(PLAN)
    return tmp_path / "plan.yaml"


def _sweep(plan: Path, *options: str) -> subprocess.CompletedProcess[str]:
    command = [TRUNDLE, "sweep", plan, *options]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)


def test_the_pushed_box_slides_as_far_as_friction_and_mass_say(plan: Path) -> None:
    done = trundle.sweep(plan, workers=1)

    rows = done.table.to_pylist()
    assert [row["row"] for row in rows] == list(range(24))
    for row in rows:
        mass, friction = row["models/box/links/link/inertial/mass"], row["mu"] * 9.8
        assert row["mass"] == mass
        push = max(10 / mass - friction, 0.0)
        assert row["fastest"] == pytest.approx(push * 0.3, abs=0.02 + 0.05 * friction)
        ended_m = 0.5 * push * 0.3**2 * (1 + push / friction)
        if ended_m < 0.5:
            assert row["x"] == pytest.approx(ended_m, abs=0.03)
        assert (row["moved_at"] is None) == (row["x"] <= 0.01)
        assert row["status"] == ("ok" if row["x"] < 0.8 else "failed")
    failed = next(row for row in rows if row["status"] == "failed")
    assert failed["reason"] == f"not x < 0.8: x = {failed['x']:.6g}"
    assert done.counts == {"ok": sum(row["x"] < 0.8 for row in rows), "failed": sum(row["x"] >= 0.8 for row in rows)}


@pytest.mark.slow
def test_a_killed_sweep_goes_on_and_its_table_is_the_same(plan: Path) -> None:
    whole = _sweep(plan, "-o", str(plan.with_name("whole")))
    assert whole.returncode == 1, whole.stderr
    assert whole.stdout.startswith("24 of 24 runs: ")

    _kill_after(plan, rows=7)
    again = _sweep(plan, "--workers", "1")

    assert again.returncode == 1, again.stderr
    tables = [plan.with_name(name) / "results.parquet" for name in ("whole", "plan.sweep")]
    assert tables[0].read_bytes() == tables[1].read_bytes()


def _kill_after(plan: Path, *, rows: int, later_s: float = 0.0) -> None:
    """Kill a sweep some time after its journal has a number of new rows."""
    journal = plan.with_suffix(".sweep") / "journal.jsonl"
    before = journal.read_bytes().count(b"\n") if journal.exists() else 0
    process = subprocess.Popen([TRUNDLE, "sweep", plan], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 120
    while process.poll() is None and time.monotonic() < deadline:
        if journal.exists() and journal.read_bytes().count(b"\n") >= before + rows:
            break
        time.sleep(0.005)
    time.sleep(later_s)
    process.kill()
    process.wait()


def test_a_row_s_number_gives_its_run_again(plan: Path) -> None:
    rows, runner = Rows(load_plan(plan)), RowRunner(load_plan(plan))
    in_order = [runner.run(row) for row in rows]

    alone = RowRunner(load_plan(plan)).run(rows.row(17))

    assert alone == in_order[17]


def test_row_runs_one_again_without_a_page(plan: Path) -> None:
    done = _sweep(plan, "--row", "17", "--headless")
    result = RowRunner(load_plan(plan)).run(Rows(load_plan(plan)).row(17))

    assert done.stdout.startswith("row 17: seed ")
    assert f"\n  x = {result.measures['x']}\n" in done.stdout
    assert done.returncode == (0 if result.status == "ok" else 1)


@pytest.mark.parametrize(
    ("changed", "by", "message"),
    [
        ("inertial/mass", "inertial/mas", "plan.yaml:5: error: models/box/links/link/inertial/mas: models/box/links/"),
        (
            "models.box.speed",
            "models.bx.speed",
            "plan.yaml:12: error: models.bx.speed: there is no 'bx'; there are: ",
        ),
        (
            "box/link,",
            "box/lnk,",
            "plan.yaml:8: error: model 'box' has no link 'lnk' (did you mean 'link'?); there are: 'link'",
        ),
        ("box.py:mass", "box.py:weight", "box.py has no function 'weight'"),
        ("x < 0.8", "y < 0.8", "plan.yaml:15: error: y < 0.8: name 'y' is not defined"),
        ("world: box.sdf", "world: model://no_such", "plan.yaml:1: error: "),
        ("  mu: [", "  m: [", "plan.yaml:6: error: vary: nothing uses 'm'; the nearest name is 'mu'; "),
        ("  mu: [", "  arguments/size: [1]\n  mu: [", "plan.yaml:6: error: arguments/size: "),
        ("  mu: [", "  parameters/gain: [1]\n  mu: [", "plan.yaml:6: error: parameters/gain: a world has no ROS "),
        ("{models", "{parameters/gain: mu, models", "plan.yaml:7: error: parameters/gain: a world has no ROS "),
    ],
)
def test_a_plan_that_cannot_run_is_refused_before_the_first_run(
    plan: Path, changed: str, by: str, message: str
) -> None:
    plan.write_text(PLAN.replace(changed, by))
    with pytest.raises(TrundleError) as caught:
        trundle.sweep(plan)
    assert message in str(caught.value)
    assert not plan.with_suffix(".sweep").exists()


def test_an_argument_that_the_xacro_file_does_not_have_is_refused_with_the_plan_s_line(tmp_path: Path) -> None:
    robot = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><xacro:arg name="width" default="1"/>'
    (tmp_path / "r.xacro").write_text(robot + '<xacro:arg name="mass" default="1"/><link name="l"/></robot>')
    plan = {"world": str(tmp_path / "r.xacro"), "duration": 1, "vary": {"arguments/widht": [1, 2]}}

    with pytest.raises(TrundleError) as caught:
        trundle.sweep(plan, output=tmp_path / "out")

    message = "no argument 'widht'; the nearest is 'width'; arguments here: 'mass', 'width'"
    assert str(caught.value) == f"plan:4: error: arguments/widht: {tmp_path / 'r.xacro'}: {message}"


@pytest.mark.slow
def test_runs_that_hang_crash_or_raise_are_rows_with_a_reason(plan: Path) -> None:
    plan.with_name("box.py").write_text("""\
import os, time
def mass(sim):
    if sim.time_ns:  # not when the plan is checked
        n = round(sim['box'].link('link').link.inertial.mass)
        print('between the results')
        if n == 1: time.sleep(1000)
        if n == 2: os._exit(3)
        if n == 3: raise KeyError('k')
        return n
""")
    text = PLAN.replace("{uniform: [0.5, 2]}", "[1, 2, 3, 4, 5]").replace("mu: [0.1, 0.5, 1]", "mu: [1]")
    plan.write_text(text.replace("samples: 8\n", "time_limit: 10\n").replace("pass: [x < 0.8]\n", ""))

    rows = trundle.sweep(plan, workers=2).table.to_pylist()

    assert [row["status"] for row in rows] == ["timeout", "lost", "error", "ok", "ok"]
    assert [row["reason"] for row in rows[:2]] == [
        "longer than the time limit of 10 s",
        "its process ended: exit code 3",
    ]
    assert rows[2]["reason"].endswith("plan.yaml:14: error: mass: KeyError: 'k'")
    assert [row["mass"] for row in rows] == [None, None, None, 4, 5]


def test_ctrl_c_stops_and_says_how_to_go_on(plan: Path) -> None:
    plan.write_text(PLAN.replace("samples: 8", "samples: 100000"))
    process = subprocess.Popen([TRUNDLE, "sweep", plan], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    journal = plan.with_suffix(".sweep") / "journal.jsonl"
    deadline = time.monotonic() + 120
    while not journal.exists() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=120)

    assert process.returncode == 130, err
    assert " of 300000 runs: " in out
    assert f"`trundle sweep {plan}` goes on" in err


@pytest.mark.slow
def test_twenty_kills_at_random_moments_change_nothing(plan: Path) -> None:
    """TRUNDLE_TEST_SEED repeats the moments of a run that failed."""
    plan.write_text(PLAN.replace("samples: 8", "samples: 600"))
    assert _sweep(plan, "-o", str(plan.with_name("whole"))).returncode == 1
    seed = int(os.environ.get("TRUNDLE_TEST_SEED") or secrets.randbits(32))
    print(f"TRUNDLE_TEST_SEED={seed}")
    random = Random(seed)

    for _ in range(20):
        _kill_after(plan, rows=random.randrange(180), later_s=random.uniform(0, 0.3))
    assert _sweep(plan).returncode == 1

    tables = [plan.with_name(name) / "results.parquet" for name in ("whole", "plan.sweep")]
    assert tables[0].read_bytes() == tables[1].read_bytes()
    assert os.listdir(tables[1].parent) == os.listdir(tables[0].parent)


def test_the_report_is_one_file_with_the_main_results(plan: Path) -> None:
    plan.write_text(PLAN.replace("samples: 8", "samples: 4"))
    visual = '<visual name="v"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></visual>'
    plan.with_name("box.sdf").write_text(WORLD.replace("</inertial>", f"</inertial>{visual}"))
    trundle.sweep(plan, workers=1)

    done = subprocess.run([TRUNDLE, "sweep", "report", plan], capture_output=True, text=True, timeout=300, check=False)

    assert done.returncode == 0, done.stderr
    html = Path(done.stdout.strip()).read_text()
    assert not re.search(r'(?:src|href)="(?!data:image/png)|url\(|@import', html), "it loads nothing"
    ElementTree.fromstring(re.sub(r"<(meta[^>]*|img[^>]*|wbr)>", r"<\1/>", html.removeprefix("<!doctype html>")))
    assert "12 runs of 1 s of box.sdf, seed 0" in html
    for heading in ("Distributions", "What matters", "Worst runs"):
        assert f"<h2>{heading}</h2>" in html
    pictures = re.findall(r'src="data:image/png;base64,([^"]+)"', html)
    assert len(pictures) == 6
    first = Image.open(io.BytesIO(base64.b64decode(pictures[0])))
    assert len(first.getcolors(1 << 20) or ()) > 20, "the box is seen"


def test_the_time_step_is_a_property(plan: Path) -> None:
    plan.with_name("box.py").write_text("def step(sim):\n    return sim.step_ns\n")
    plan.write_text("""\
world: box.sdf
duration: 0.1
vary: {time_step: [0.001, 0.004]}
measure: {step: {function: box.py:step}}
""")
    read = load_plan(plan)

    steps = [RowRunner(read).run(row).measures["step"] for row in Rows(read)]

    assert steps == [1_000_000, 4_000_000]


def test_there_is_no_report_before_the_first_run(plan: Path) -> None:
    done = subprocess.run([TRUNDLE, "sweep", "report", plan], capture_output=True, text=True, timeout=300, check=False)
    assert (done.returncode, done.stdout) == (1, "")
    assert f"no results; run `trundle sweep {plan}` first" in done.stderr
    assert not plan.with_suffix(".sweep").exists()


@pytest.mark.slow
def test_a_plan_is_a_test_with_a_case_for_each_run(plan: Path) -> None:
    command = [TRUNDLE, "test", plan, "--junit", plan.with_name("junit.xml")]
    failed = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    plan.write_text(PLAN.replace("x < 0.8", "x < 80"))
    passed = subprocess.run(command[:3], capture_output=True, text=True, timeout=300, check=False)

    ok = len([row for row in trundle.sweep(plan, output=plan.with_name("o")).table.to_pylist() if row["x"] < 0.8])
    assert (passed.returncode, passed.stdout) == (0, f"{plan}: ok in 24 of 24 variations\n")
    assert failed.returncode == 2, failed.stderr
    assert failed.stdout.startswith(f"{plan}: ok in {ok} of 24 variations\n  row ")
    cases = ElementTree.parse(plan.with_name("junit.xml")).findall(".//testcase")
    assert [case.get("name") for case in cases] == [f"row {i}" for i in range(24)]
    assert sum(case.find("failure") is not None for case in cases) == 24 - ok
    assert not plan.with_suffix(".sweep").exists()
