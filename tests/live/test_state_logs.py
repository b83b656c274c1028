"""State logs of gzserver -r and of the page."""

from pathlib import Path

import pytest
from tests.gazebo_server import PATIENCE_S, Gazebo, until

import trundle
from trundle.app.cli import main
from trundle.base.diagnostics import UsageError
from trundle.gazebo.nodes.gazebo import GazeboServer
from trundle.live.state_logs import PageRecording
from trundle.ros import Node
from trundle.sim.simulation import read_state_log

BALL = """<sdf version="1.6"><model name="ball"><link name="l"><pose>0 0 9 0 0 0</pose>
<inertial><mass>1</mass></inertial></link></model></sdf>"""


def _record(gazebo: Gazebo, folder: Path) -> None:
    server = Node("/gazebo", loop=gazebo.loop, master_uri=gazebo.client.master_uri)
    gazebo.loop.spawn(GazeboServer(server, ["-u", "-r", "--record_path", str(folder)], gazebo.host).run())
    gazebo.loop.run(gazebo.client.wait_for_service("/gazebo/unpause_physics", PATIENCE_S), timeout_s=PATIENCE_S)
    gazebo.loop.run(server.wait_registered())


def test_each_spawned_model_starts_a_new_state_log(bare_gazebo: Gazebo, tmp_path: Path) -> None:
    folder, gazebo = tmp_path / "logs", bare_gazebo
    _record(gazebo, folder)
    gazebo.call("unpause_physics")
    until(lambda: (folder / "state.log").is_file())
    assert gazebo.spawn(BALL, "ball").success
    start_s = gazebo.time_s
    gazebo.until_s(start_s + 0.3)
    gazebo.world.close()

    assert "ball::l" not in read_state_log(folder / "state.log").links
    log = read_state_log(folder / "state-2.log")
    ball = log.links.index("ball::l")
    fallen, first_s, last_s = log.poses[:, ball, 2], log.times_s[0] - start_s, log.times_s[-1] - start_s
    assert last_s - first_s > 0.2
    # Both ends of the fall lie on one parabola from rest at 9 m, wherever on it the log begins.
    assert (9.0 - fallen[-1]) ** 0.5 - (9.0 - fallen[0]) ** 0.5 == pytest.approx(
        4.9**0.5 * (last_s - first_s), abs=0.02
    )
    assert '<model name="ball"' in log.sdf
    assert [line for line in gazebo.lines if "state-2.log; trundle play shows it" in line]


def test_an_unwritable_log_folder_is_reported_and_the_world_continues(bare_gazebo: Gazebo, tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("")
    _record(bare_gazebo, tmp_path / "taken")
    bare_gazebo.call("unpause_physics")
    until(lambda: any("recording failed" in line for line in bare_gazebo.lines))
    bare_gazebo.until_s(bare_gazebo.time_s + 0.05)


def test_page_recording_holds_the_recorded_part_of_a_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    lines: list[str] = []
    sim = trundle.load("model://ball")
    recording = PageRecording(sim, lines.append)
    assert recording.since_ns is None

    sim.run(0.5)
    recording.set(True)
    recording.set(True)
    sim.run(1.0)
    assert recording.since_ns == 500_000_000
    recording.set(False)
    sim.run(1.0)

    assert recording.since_ns is None
    (file,) = tmp_path.glob("recorded/*/state.log")
    log = read_state_log(file)
    assert (log.times_s[0], log.times_s[-1]) == pytest.approx((0.5, 1.5))
    assert [str(file.relative_to(tmp_path)) in line for line in lines] == [True]


def test_two_recordings_in_one_second_are_both_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    sim = trundle.load("model://ball")
    recording = PageRecording(sim, lambda _: None)
    for _ in range(2):
        recording.set(True)
        sim.run(0.1)
        recording.set(False)

    logs = map(read_state_log, tmp_path.glob("recorded/*/state.log"))
    assert sorted(float(log.times_s[0]) for log in logs) == pytest.approx((0.0, 0.1))


def test_a_recording_that_cannot_be_written_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "recorded").write_text("a file, not a folder")
    recording = PageRecording(trundle.load("model://ball"), lambda _: None)

    with pytest.raises(UsageError, match="cannot be written"):
        recording.set(True)

    assert recording.since_ns is None


_SPAWNING = """<sdf version="1.6"><world name="w">
<model name="first"><link name="l"><inertial><mass>1</mass></inertial></link>
<plugin name="spawn" filename="libspawner.so"/></model></world></sdf>"""
_SPAWNER = """
from msgspec.structs import replace
from trundle import Plugin

class Spawner(Plugin):
    period_ns = 500_000_000

    @classmethod
    def load(cls, sim, model, node, tag):
        return cls()

    def before_step(self, sim):
        if sim.time_ns == 500_000_000:
            sim.spawn(replace(sim["first"].model, name="second", plugins=()))
        elif sim.time_ns == 1_000_000_000:
            sim.delete("second")
"""


def test_a_run_is_recorded_on_in_a_further_file_when_its_models_change(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "w.sdf").write_text(_SPAWNING)
    (tmp_path / "spawner.py").write_text(_SPAWNER)

    words = ("run", "w.sdf", "--headless", "--no-ros", "--speed", "max", "--duration", "1.5", "--record", "run.log")
    assert main([*words]) == 0

    logs = [read_state_log(tmp_path / name) for name in ("run.log", "run-2.log", "run-3.log")]
    assert [log.links for log in logs] == [("first::l",), ("first::l", "second::l"), ("first::l",)]
    assert [(float(log.times_s[0]), float(log.times_s[-1])) for log in logs] == [
        pytest.approx(times, abs=0.021) for times in ((0.0, 0.5), (0.5, 1.0), (1.0, 1.5))
    ]
    assert '<model name="second"' in logs[1].sdf
    assert "recording into run-2.log; trundle play shows it" in "".join(capsys.readouterr())
