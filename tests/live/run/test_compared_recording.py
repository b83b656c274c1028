"""`trundle run --compare`: a file that cannot be compared is told before anything starts."""

from pathlib import Path

import pytest
from tests.recorded_drives import write_drive

import trundle
from trundle.app.cli.main import main
from trundle.live.state_logs import start_state_log

WORLD = '<sdf version="1.6"><world name="w"><model name="{name}"><link name="l"/></model></world></sdf>'


@pytest.mark.parametrize(
    ("name", "more", "sentence"),
    [
        ("text.log", (), "text.log:1: error: not a state log"),
        ("missing.log", (), "missing.log"),
        ("cut.bag", (), "bag unindexed"),
        ("drive.bag", ("--no-ros",), "drive.bag is a bag, which is compared with topics: leave --no-ros out"),
        ("other.log", (), "other.log is a recording of another world: it has ball, and here box can move"),
    ],
)
def test_a_file_that_cannot_be_compared_ends_the_run_before_it_starts(
    name: str, more: tuple[str, ...], sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    world, other = tmp_path / "w.sdf", tmp_path / "other.sdf"
    world.write_text(WORLD.format(name="box"))
    other.write_text(WORLD.format(name="ball"))
    sim = trundle.load(str(other))
    recorder = start_state_log(tmp_path / "other.log", sim, sim.world, sim.report)
    sim.add_hook(recorder, period_ns=recorder.period_ns)
    sim.run(0.1)
    recorder.close()
    (tmp_path / "text.log").write_text("hello\n")
    drive = write_drive(tmp_path / "drive.bag", speed=0.5, seconds=0.5)
    (tmp_path / "cut.bag").write_bytes(drive.read_bytes()[:2000])

    assert main(["run", str(world), "--port", "0", "--duration", "1", "--compare", str(tmp_path / name), *more]) == 1

    printed = capsys.readouterr().err
    assert sentence in printed
    assert "see it at" not in printed, "no page was opened"
    assert "master" not in printed, "no graph was started"
    assert "Traceback" not in printed
