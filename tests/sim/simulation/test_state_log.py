"""Recordings that can be cut anywhere and still be read."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

import trundle
from trundle.base.diagnostics import DescriptionError
from trundle.sim.simulation import Simulation, StateRecorder, read_state_log

MODEL = """<sdf version="1.6"><model name="m"><link name="a"/><link name="b"><pose>0 0 1 0 0 0</pose></link>
<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 1 0</xyz></axis></joint></model></sdf>"""


def recorded(folder: Path) -> tuple[Path, Simulation]:
    (folder / "m.sdf").write_text(MODEL)
    sim = trundle.load(str(folder / "m.sdf"))
    compiled = sim.engine.compiled
    path = folder / "run.log"
    recorder = StateRecorder(path, links=compiled.link_names, joints=compiled.joint_names, sdf="<sdf/>")
    sim.add_hook(recorder, period_ns=recorder.period_ns)
    sim["m"].joint("j").command_effort(0.3)
    sim.run(0.5)
    recorder.close()
    return path, sim


def test_a_log_contains_every_pose_with_its_time(tmp_path: Path) -> None:
    path, sim = recorded(tmp_path)

    log = read_state_log(str(path))

    assert log.times_s == pytest.approx(np.arange(1, 26) * 0.02)
    assert log.links[:2] == ("m::a", "m::b")
    assert log.poses[-1] == pytest.approx(sim.snapshot().poses, abs=0)
    assert log.positions[-1, log.joints.index("m::j")] == sim["m"].joint("j").position != 0.0


def test_a_truncated_log_is_read_up_to_its_last_row(tmp_path: Path) -> None:
    path, _ = recorded(tmp_path)
    whole = path.read_bytes()
    path.write_bytes(whole[:-13])

    assert len(read_state_log(path).times_s) == 24


@pytest.mark.parametrize("number", [np.nan, np.inf, 1e200, -1e39, 0.0])
@pytest.mark.parametrize("column", [0, 1, 4])
def test_a_damaged_row_is_reported_by_number(tmp_path: Path, column: int, number: float) -> None:
    """Time, x and qw: zero is damage only in a quaternion."""
    path, _ = recorded(tmp_path)
    header, newline, data = path.read_bytes().partition(b"\n")
    rows = np.frombuffer(data).reshape(25, -1).copy()
    rows[2, column] = number
    if np.isnan(number):
        rows.view(np.uint64)[2, column] = 0x7FF0_0000_0000_0001  # a signalling one, of which numpy warns
    path.write_bytes(header + newline + rows.tobytes())

    if number == 0.0 and column != 4:
        assert len(read_state_log(path).times_s) == 25
    else:
        with pytest.raises(DescriptionError, match=r"run.log: error: row 3 of 25 is damaged"):
            read_state_log(path)


def test_two_runs_write_the_same_bytes(tmp_path: Path) -> None:
    (tmp_path / "one").mkdir()
    (tmp_path / "two").mkdir()

    assert recorded(tmp_path / "one")[0].read_bytes() == recorded(tmp_path / "two")[0].read_bytes()


@given(content=st.binary(max_size=200) | st.text(max_size=100).map(lambda t: b'{"format": ' + t.encode() + b"}\n"))
def test_other_files_are_not_state_logs(tmp_path_factory: pytest.TempPathFactory, content: bytes) -> None:
    path = tmp_path_factory.mktemp("log") / "x"
    path.write_bytes(content)

    with pytest.raises(DescriptionError, match="not a state log"):
        read_state_log(path)
