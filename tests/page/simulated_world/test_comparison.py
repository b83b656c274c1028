"""Comparison of a page's simulation with a recording: what the page is sent, and the numbers."""

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.page.simulated_world.test_page import Shown
from tests.page.simulated_world.worlds import loaded, model

from trundle.app.compare import compare_logs
from trundle.live.state_logs import start_state_log
from trundle.page import Compare, DeleteModel, MoveJoint, Reset, Seek, SetReferenceOffset, Step, StopComparing
from trundle.page.shown_world import BareWorld
from trundle.sim.simulation import Simulation, read_state_log
from trundle.sim.timeline import Timeline

BALL = '<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'
ARM = """<model name="arm"><link name="base"/><link name="lever"><pose>0 0 1 0 0 0</pose></link>
<joint name="root" type="fixed"><parent>world</parent><child>base</child></joint>
<joint name="hinge" type="revolute"><parent>base</parent><child>lever</child><axis><xyz>0 1 0</xyz></axis></joint>
</model>"""


def world(height: float) -> str:
    ball = model("ball", BALL, static=False).replace("<static>", f"<pose>0 0 {height} 0 0 0</pose><static>", 1)
    return model("floor") + ball + ARM


def simulate(folder: Path, height: float) -> Simulation:
    folder.mkdir()
    return loaded(folder, world(height))[0]


def record(sim: Simulation, file: Path, seconds: float) -> Path:
    """Record a run."""
    recorder = start_state_log(file, sim, sim.world, sim.report)
    sim.add_hook(recorder, period_ns=recorder.period_ns)
    sim.run(seconds)
    recorder.close()
    return file


def compare(file: Path, title: str = "run.log") -> Compare:
    return Compare(file=os.fsencode(file), title=title)


@pytest.fixture(scope="module")
def reference(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A second of a ball that falls from 50 m."""
    folder = tmp_path_factory.mktemp("reference")
    return record(simulate(folder / "world", 50.0), folder / "run.log", 1.0)


@pytest.fixture
def shown(tmp_path: Path, reference: Path) -> Shown:
    """Page of the same world, whose ball falls from 49 m; it is compared with the recording."""
    sim = simulate(tmp_path / "run", 49.0)
    shown = Shown(sim, timeline=Timeline(sim))
    shown.wait_world(1)
    assert shown.ask(compare(reference)) is None
    return shown


def rows(shown: Shown) -> dict[tuple[str, str], dict[str, Any]]:
    """Return the differences that were sent last."""
    shown.update(0.2)
    return {(row["name"], row["quantity"]): row for row in shown.server.differences[-1]["rows"]}


def test_the_manifest_names_the_recording_and_its_samples(shown: Shown, reference: Path) -> None:
    manifest, files = shown.server.worlds[-1]
    info, log = manifest["reference"], read_state_log(reference)

    assert (info["title"], info["start"], info["offset"], info["samples"]) == ("run.log", 0.0, 0.0, 51)
    assert info["duration"] == pytest.approx(1.0)
    assert info["links"] == ["ball::l", "arm::base", "arm::lever"]
    assert info["joints"] == ["arm::root", "arm::hinge"]
    assert info["url"] in manifest["resources"]
    data = files[info["url"]]
    times = np.frombuffer(data, "<f8", 51)
    poses = np.frombuffer(data, "<f4", 51 * 3 * 7, 51 * 8 + 51 * 2 * 8).reshape(51, 3, 7)
    assert times == pytest.approx(log.times_s)
    assert poses[:, 0, :3] == pytest.approx(log.poses[:, log.links.index("ball::l"), :3], rel=1e-6)
    assert poses[0, 0, 3:].tolist() == [0.0, 0.0, 0.0, 1.0]


def test_the_differences_are_those_of_the_recorded_run(shown: Shown, reference: Path, tmp_path: Path) -> None:
    """The page and `trundle compare` find the same numbers."""
    recorder = start_state_log(tmp_path / "new.log", shown.sim, shown.sim.world, shown.sim.report)
    shown.sim.add_hook(recorder, period_ns=recorder.period_ns)
    shown.ask(MoveJoint("arm", "hinge", velocity=3.0))
    shown.ask(Step(100))
    shown.ask(Step(100))
    while shown.sim.time_ns < 200_000_000:
        shown.ask(Step(1))
    recorder.close()

    found = rows(shown)

    assert found["ball", "distance"]["now"] == pytest.approx(1.0)
    assert found["arm::hinge", "position"]["now"] > 0.1
    expected = {(row.name, row.quantity): row for row in compare_logs(tmp_path / "new.log", reference).rows}
    assert set(expected) <= set(found)
    for key, row in expected.items():
        numbers = (row.now, row.maximum, row.maximum_time, row.rms)
        assert [found[key][field] for field in ("now", "maximum", "maximum_time", "rms")] == pytest.approx(numbers)


def test_only_what_can_move_is_compared(shown: Shown) -> None:
    assert {name for name, _ in rows(shown)} == {"ball", "arm", "arm::root", "arm::hinge"}
    assert [row["name"] for row in shown.server.differences[-1]["rows"]][:2] == ["ball", "ball"], "the farthest first"


def test_after_a_seek_the_maximum_is_of_the_time_before(shown: Shown) -> None:
    """The hinge, which rests in the recording, is driven from 50 ms on."""
    shown.ask(Step(50))
    shown.ask(MoveJoint("arm", "hinge", velocity=3.0))
    shown.ask(Step(100))
    shown.ask(Step(50))
    late = rows(shown)["arm::hinge", "position"]

    assert shown.ask(Seek(100_000_000)) is None
    early = rows(shown)["arm::hinge", "position"]
    shown.ask(Step(100))
    again = rows(shown)["arm::hinge", "position"]

    assert 0.01 < early["maximum"] < late["maximum"]
    assert early["maximum_time"] == pytest.approx(0.1)
    assert again == late


def test_a_reset_begins_the_comparison_again(shown: Shown) -> None:
    shown.ask(MoveJoint("arm", "hinge", velocity=3.0))
    shown.ask(Step(100))
    assert rows(shown)["arm::hinge", "position"]["maximum"] > 0.04

    shown.ask(Reset())
    shown.ask(Step(60))

    hinge = rows(shown)["arm::hinge", "position"]
    assert (hinge["maximum"], hinge["rms"]) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_an_offset_shifts_the_recording(shown: Shown) -> None:
    """At 0.1 s the ball fell from 49 m for 0.1 s, and the recorded one from 50 m for 0.06 s."""
    shown.ask(Step(100))
    gravity = 9.8

    assert shown.ask(SetReferenceOffset(0.04)) is None

    assert shown.server.worlds[-1][0]["reference"]["start"] == 0.04
    fallen = gravity / 2 * (0.1**2 - 0.06**2)
    assert rows(shown)["ball", "distance"]["now"] == pytest.approx(1.0 + fallen, rel=1e-2)
    shown.ask(SetReferenceOffset(5.0))
    assert rows(shown) == {}, "it has not started"


def test_a_deleted_model_has_no_difference(shown: Shown) -> None:
    shown.ask(Step(40))
    shown.ask(DeleteModel("ball"))
    shown.update(0.2)
    shown.ask(Step(40))

    ball = rows(shown)["ball", "distance"]

    assert ball["now"] is None
    assert ball["maximum"] == pytest.approx(1.0)
    assert rows(shown)["arm", "distance"]["now"] == 0.0


def test_another_world_of_the_page_is_compared_from_its_start(shown: Shown, tmp_path: Path) -> None:
    """As after loading the world again."""
    shown.ask(Step(40))
    shown.page.show(BareWorld(simulate(tmp_path / "again", 48.0)), node=None, recorder=None)
    shown.wait_world(2)

    assert shown.server.worlds[-1][0]["reference"]["title"] == "run.log"
    assert rows(shown)["ball", "distance"]["maximum"] == pytest.approx(2.0)


def test_a_recording_of_another_world_or_a_damaged_one_is_refused(shown: Shown, tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    other = record(loaded(tmp_path / "other", model("car", BALL, static=False))[0], tmp_path / "other/run.log", 0.1)
    (tmp_path / "text.log").write_text("hello")
    data = bytearray(other.read_bytes())
    data[-8:] = np.array([np.nan]).tobytes()
    (tmp_path / "nan.log").write_bytes(data)

    assert shown.ask(compare(other)) == (
        "run.log is a recording of another world: it has car, and here ball, arm can move"
    )
    assert (shown.ask(compare(tmp_path / "text.log", "text.log")) or "").startswith(
        "text.log:1: error: not a state log"
    )
    assert "row 6 of 6 is damaged" in (shown.ask(compare(tmp_path / "nan.log")) or "")
    assert "cannot be read" in (shown.ask(compare(tmp_path / "none.log")) or "")
    assert shown.server.worlds[-1][0]["reference"]["title"] == "run.log", "the former comparison goes on"


def test_comparing_ends(shown: Shown) -> None:
    assert shown.ask(StopComparing()) is None

    assert shown.server.worlds[-1][0]["reference"] is None
    sent = len(shown.server.differences)
    shown.ask(Step(40))
    shown.update(0.2)
    assert len(shown.server.differences) == sent
    assert shown.ask(SetReferenceOffset(1.0)) == "nothing is compared"
