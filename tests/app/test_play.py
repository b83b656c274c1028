"""Playback of a state log on a page."""

import os
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
from msgspec.structs import replace
from tests.page.simulated_world.fake_server import FakeServer
from tests.recorded_drives import write_drive

import trundle
from trundle.app.compare import compare_logs
from trundle.app.play import LogPage, PlayOptions, play
from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.live.state_logs import start_state_log
from trundle.page import (
    Compare,
    PageAction,
    PageServer,
    Pause,
    Play,
    RenderView,
    Seek,
    SetReferenceOffset,
    SetSpeed,
    StopComparing,
)
from trundle.sim.simulation import Simulation, read_state_log

PENDULUM = """<sdf version="1.6"><world name="w"><model name="m"><link name="arm"><pose>0 0 1 0 0 0</pose>
<inertial><pose>0.5 0 0 0 0 0</pose></inertial></link>
<joint name="hinge" type="revolute"><parent>world</parent><child>arm</child><axis><xyz>0 1 0</xyz></axis></joint>
</model></world></sdf>"""


@pytest.fixture
def recording(tmp_path: Path) -> tuple[Simulation, Path]:
    """Two seconds of a pendulum."""
    (tmp_path / "w.sdf").write_text(PENDULUM)
    sim = trundle.load(str(tmp_path / "w.sdf"))
    recorder = start_state_log(tmp_path / "run.log", sim, sim.world, sim.report)
    sim.add_hook(recorder, period_ns=recorder.period_ns)
    sim.run(2.0)
    recorder.close()
    return sim, tmp_path / "run.log"


def open_page(recording: tuple[Simulation, Path], **options: Any) -> tuple[LogPage, FakeServer]:
    server = FakeServer()
    return LogPage(cast(PageServer, server), read_state_log(recording[1]), recording[0], PlayOptions(**options)), server


def test_a_log_is_played_with_its_poses_and_joints(recording: tuple[Simulation, Path]) -> None:
    page, server = open_page(recording, speed=2.0)
    log = read_state_log(recording[1])

    page.update(0.5)

    time_ns, poses = server.poses[-1]
    assert time_ns == 1_000_000_000
    assert poses == pytest.approx(log.poses[50])
    _, joints = server.joints[-1]
    velocity = (log.positions[50, 0] - log.positions[49, 0]) / 0.02
    assert joints[0, :2] == pytest.approx([log.positions[50, 0], velocity])
    assert np.isnan(joints[0, 2])
    state = server.states[-1]
    assert (state.timeline.start_ns, state.timeline.end_ns, state.speed) == (0, 2_000_000_000, 2.0)


def test_the_world_of_a_log_is_served_with_its_files(recording: tuple[Simulation, Path]) -> None:
    page, server = open_page(recording)
    while not server.worlds:
        page.update(0.01)

    manifest, files = server.worlds[0]
    assert [file["id"] for file in manifest["files"]] == ["", "m"]
    assert {file["url"] for file in manifest["files"]} <= set(files)


def test_pause_seek_and_speed_requests_are_answered(recording: tuple[Simulation, Path]) -> None:
    page, server = open_page(recording)
    pause, seek = server.ask(Pause()), server.ask(Seek(1_500_000_000))
    fast = server.ask(SetSpeed(None))

    page.update(1.0)

    assert server.poses[-1][0] == 1_500_000_000
    assert [server.answers[number] for number in (pause, seek, fast)] == [None, None, None]


def test_pictures_are_rendered_at_the_time_of_playback(recording: tuple[Simulation, Path]) -> None:
    page, server = open_page(recording)
    number = server.ask(RenderView(width=64, height=48))

    page.update(0.1)

    assert server.pictures.get(timeout=60)[0] == number


def test_two_logs_are_compared(recording: tuple[Simulation, Path], tmp_path: Path) -> None:
    """The pendulum of the second begins at another angle; the page's numbers are those of `trundle compare`."""
    _, file = recording
    other = tmp_path / "other.log"
    sim = trundle.load(str(tmp_path / "w.sdf"))
    sim["m"].joint("hinge").set_position(0.3)
    recorder = start_state_log(other, sim, sim.world, sim.report)
    sim.add_hook(recorder, period_ns=recorder.period_ns)
    sim.run(1.0)
    recorder.close()
    page, server = open_page(recording, paused=True)
    while not server.worlds:
        page.update(0.01)

    numbers = [server.ask(Compare(file=os.fsencode(other), title="other.log")), server.ask(Seek(1_000_000_000))]
    for _ in range(3):
        page.update(0.0)

    assert [server.answers[number] for number in numbers] == [None, None]
    manifest, files = server.worlds[-1]
    assert (manifest["reference"]["title"], manifest["reference"]["duration"]) == ("other.log", pytest.approx(1.0))
    assert manifest["reference"]["url"] in files
    expected = {(row.name, row.quantity): row for row in compare_logs(file, other).rows}
    found = {(row["name"], row["quantity"]): row for row in server.differences[-1]["rows"]}
    assert found["m::hinge", "position"]["maximum"] >= 0.3
    assert found["m", "angular velocity"]["maximum"] > 0.3
    for key, row in expected.items():
        assert found[key]["maximum"] == pytest.approx(row.maximum), key
        assert found[key]["now"] == pytest.approx(row.now), key

    shift, stop = server.ask(SetReferenceOffset(1.5)), server.ask(StopComparing())
    page.update(0.0)
    assert (server.answers[shift], server.answers[stop]) == (None, None)
    assert [world["reference"] and world["reference"]["start"] for world, _ in server.worlds[-2:]] == [1.5, None]


def test_the_plotted_values_of_a_log_are_sent_as_it_is_played(recording: tuple[Simulation, Path]) -> None:
    page, server = open_page(recording, paused=True)
    log = read_state_log(recording[1])
    page.update(0.0)
    assert server.series == []
    server.ask(Seek(1_000_000_000))
    server.plotted = ("m.pose.pitch", "m::arm.twist.angular.y", "m::hinge.velocity", "m.contact.count", "n.pose.x")

    page.update(0.0)
    first, head, rows = server.series[-1]

    assert (first, head["names"], head["units"]) == (0, list(server.plotted[:3]), ["rad", "rad/s", "rad/s"])
    assert head["faults"]["n.pose.x"] == "no model, link or joint for n.pose.x"
    assert head["faults"]["m.contact.count"].startswith("no value m.contact.count was recorded; there are: pose.x, ")
    assert rows[:, 0] == pytest.approx(log.times_s[:51]), "what was played so far"
    assert np.sin(rows[:, 1]) == pytest.approx(np.sin(log.positions[:51, 0]), abs=1e-6)
    slopes = np.gradient(log.positions[:, 0], log.times_s)[:51]
    assert rows[1:, 2] == pytest.approx(slopes[1:], abs=1e-6)
    assert rows[1:, 3] == pytest.approx(slopes[1:], abs=1e-6)


def test_plots_of_a_log_follow_its_playback(recording: tuple[Simulation, Path]) -> None:
    """A page that misses a message gets its rows with the next one; what is played again is sent again."""
    page, server = open_page(recording, paused=True)
    server.plotted = ("m.pose.pitch",)
    numbers: dict[int, float] = {}

    def update(*actions: PageAction) -> list[float]:
        for action in actions:
            server.ask(action)
        page.update(0.0)
        first, _, rows = server.series[-1]
        known = len(numbers)
        numbers.update({first + at: float(time) for at, time in enumerate(rows[:, 0])})
        assert list(numbers) == list(range(len(numbers)))
        return [numbers[at] for at in range(known, len(numbers))]

    assert update() == [0.0]
    assert update(Seek(60_000_000)) == pytest.approx([0.02, 0.04, 0.06])
    server.ask(Seek(80_000_000))
    page.update(0.0)
    assert update(Seek(100_000_000)) == pytest.approx([0.08, 0.1])
    assert update(Seek(20_000_000)) == [], "scrubbing keeps the curves"
    assert update(Play()) == pytest.approx([0.0, 0.02])


def test_the_states_after_a_reset_are_played(recording: tuple[Simulation, Path]) -> None:
    log = read_state_log(recording[1])
    again = np.r_[0:30, 0 : len(log.times_s)]
    recorded = replace(log, times_s=log.times_s[again], poses=log.poses[again], positions=log.positions[again])
    server = FakeServer()
    page = LogPage(cast(PageServer, server), recorded, recording[0], PlayOptions())

    page.update(1.0)

    assert server.poses[-1][1] == pytest.approx(log.poses[50])


def test_only_state_logs_of_this_world_are_compared(recording: tuple[Simulation, Path], tmp_path: Path) -> None:
    bag, other = write_drive(tmp_path / "run.bag", speed=0.5, seconds=0.5), tmp_path / "other.log"
    content = recording[1].read_bytes()
    other.write_bytes(content.replace(b'"m::arm"', b'"n::arm"', 1))
    page, server = open_page(recording)

    number = server.ask(Compare(file=os.fsencode(other), title="other.log"))
    page.update(0.0)

    assert server.answers[number] == "other.log is a recording of another world: it has n, and here m can move"
    with pytest.raises(UsageError, match="is no bag, and a bag can only be compared with a bag"):
        play(bag, PlayOptions(compare=recording[1]))
    with pytest.raises(UsageError, match="is a bag, and a state log can only be compared with a state log"):
        play(recording[1], PlayOptions(compare=bag))


def test_an_empty_log_is_refused(recording: tuple[Simulation, Path]) -> None:
    _, file = recording
    with file.open("rb") as log:
        header = log.readline()
    file.write_bytes(header)

    with pytest.raises(DescriptionError, match="nothing was recorded"):
        play(file, PlayOptions())
