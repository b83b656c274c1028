"""Streams and requests of a simulation's page, with a fake server."""

import io
import json
import re
import time
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import numpy as np
import pytest
from msgspec import UNSET
from PIL import Image
from tests.page.simulated_world.fake_server import shared_page
from tests.page.simulated_world.worlds import BOX, CAMERA, lidar, loaded, model
from tests.page_client import ProtocolClient, page_url
from tests.sim.gltf.glb import Glb
from tests.skinned import bending_column

from trundle.base.diagnostics import Source
from trundle.base.http.page_address import PageAddress
from trundle.live.state_logs import PageRecording
from trundle.page import (
    LINES,
    BeginDraft,
    LeaveDraft,
    MoveJoint,
    Pause,
    Play,
    Record,
    Reload,
    RenderView,
    Reset,
    RunTo,
    Seek,
    SetField,
    SetPhysics,
    SetSpeed,
    Step,
    TimelineSpan,
)
from trundle.page.shared_page import SharedPage
from trundle.page.shown_world import BareWorld
from trundle.page.simulated_world import pictures
from trundle.page.simulated_world.page import SimulationPage
from trundle.sim.realtime_pacer import RealtimePacer
from trundle.sim.simulation import DebugLine, Simulation, read_state_log
from trundle.sim.timeline import Timeline

CART = """<model name="cart"><link name="base"/><link name="wheel"><pose>0 0 1 0 0 0</pose></link>
<joint name="axle" type="revolute"><parent>base</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis></joint>
<joint name="ball" type="ball"><parent>base</parent><child>foot</child></joint><link name="foot"/></model>"""


class Clock:
    """Wall clock that tests advance."""

    now_ns = 10**9

    def __call__(self) -> int:
        return self.now_ns


class Shown:
    """Simulation with a page."""

    def __init__(self, sim: Simulation, sensors: Any = (), recorder: Any = None, timeline: Any = None) -> None:
        self.sim, self.clock = sim, Clock()
        page, self.server = shared_page()
        self.page = SimulationPage(page, BareWorld(sim, sensors, timeline), recorder=recorder, wall_ns=self.clock)
        self.pacer = RealtimePacer(1.0)
        self.paused = False

    def update(self, after_s: float = 0.0) -> None:
        self.clock.now_ns += round(after_s * 1e9)
        self.page.update(self.pacer, paused=self.paused)

    def wait_world(self, generation: int) -> dict[str, Any]:
        """Wait for the manifest of a generation, which a thread makes."""
        while not self.server.worlds or self.server.worlds[-1][0]["generation"] < generation:
            self.update(0.1)
            time.sleep(0.001)
        return self.server.worlds[-1][0]

    def ask(self, action: Any) -> str | None:
        number = self.server.ask(action)
        self.paused = self.page.handle_requests(self.pacer, paused=self.paused)
        return self.server.answers[number]


@pytest.fixture
def cart(tmp_path: Path) -> Shown:
    return Shown(loaded(tmp_path, CART)[0])


def test_the_manifest_has_files(cart: Shown) -> None:
    manifest = cart.wait_world(1)

    assert [file["id"] for file in manifest["files"]] == ["", "cart"]
    assert {file["url"] for file in manifest["files"]} <= set(cart.server.worlds[-1][1])


def test_a_texture_that_cannot_be_read_is_reported(tmp_path: Path) -> None:
    (tmp_path / "paint.png").write_text("no image")
    paint = "<material><pbr><metal><albedo_map>paint.png</albedo_map></metal></pbr></material></visual>"
    shown = Shown(loaded(tmp_path, model("m", BOX.replace("</visual>", paint)))[0])

    shown.wait_world(1)

    (warning,) = shown.sim.report.warnings
    assert warning.endswith(
        "paint.png: warning: the texture cannot be read: it is not an image; a plain color is drawn"
    )


def test_warnings_about_files_are_notices_with_lines(tmp_path: Path) -> None:
    """The page counts and lists them."""
    shown = Shown(loaded(tmp_path, '<model name="m"><link name="l"><hue>3</hue></link></model>')[0])
    shown.update()
    ((name, text),) = shown.server.notices
    assert name == "file/0"
    assert re.fullmatch(r"\S+:\d+: <hue> .*", str(text))

    shown.sim.report.warn(Source("cart.sdf", 7), "mass must be > 0 kg")
    shown.update(1.0)
    shown.update(1.0)
    assert shown.server.notices[2:] == [("file/1", "cart.sdf:7: mass must be > 0 kg")]


def test_poses_match_the_simulation(cart: Shown) -> None:
    cart.sim.run(0.5)
    cart.update()

    time_ns, poses = cart.server.poses[-1]
    assert time_ns == 500_000_000
    assert poses == pytest.approx(cart.sim.snapshot().poses)


def test_poses_are_sent_at_30_hz_and_joints_at_10_hz(cart: Shown) -> None:
    for _ in range(1000):
        cart.update(0.001)

    assert 28 <= len(cart.server.poses) <= 31
    assert 9 <= len(cart.server.joints) <= 11
    assert len(cart.server.states) == 1  # nothing changed


def test_unwatched_streams_are_not_put(cart: Shown) -> None:
    cart.server.watched = set()
    cart.update()

    assert cart.server.poses == cart.server.joints == cart.server.lines == []
    assert len(cart.server.states) == 1


def test_joints_have_position_velocity_and_effort(cart: Shown) -> None:
    axle = cart.sim["cart"].joint("axle")
    axle.set_position(0.4)
    axle.command_effort(0.02)
    cart.sim.run(0.1)
    cart.update()

    _, joints = cart.server.joints[-1]
    assert joints == pytest.approx(np.array([[axle.position, axle.velocity, axle.effort]]))
    assert axle.velocity > 0.0


def test_body_numbers_stay_when_models_are_spawned_and_deleted(tmp_path: Path) -> None:
    sim, _ = loaded(tmp_path, model("a", BOX) + model("b", BOX))
    shown = Shown(sim)
    shown.wait_world(1)

    sim.delete("a")
    manifest = shown.wait_world(2)

    assert [m["links"][0]["body"] for m in manifest["models"]] == [1]
    assert [file["id"] for file in manifest["files"]] == ["", "b"]
    shown.update(0.1)
    assert shown.server.poses[-1][1][1] == pytest.approx(sim.snapshot().poses[0])


def test_pause_step_and_play(cart: Shown) -> None:
    assert cart.ask(Pause()) is None
    assert cart.paused
    assert cart.server.states[-1].paused

    cart.ask(Step(3))
    assert cart.paused
    assert cart.sim.steps == 3
    assert cart.server.states[-1].time_ns == cart.sim.time_ns

    cart.ask(Play())
    assert not cart.paused


def test_steps_are_done_a_hundred_at_a_time_until_play(cart: Shown) -> None:
    cart.ask(Step(250))
    assert cart.sim.steps == 100
    for _ in range(5):
        cart.page.handle_requests(cart.pacer, paused=True)
    assert cart.sim.steps == 250

    cart.ask(Step(1000))
    cart.ask(Pause())
    cart.page.handle_requests(cart.pacer, paused=True)
    assert cart.sim.steps == 350


def test_run_to_steps_up_to_a_future_time(cart: Shown) -> None:
    assert cart.ask(RunTo(150_500_000)) is None
    assert cart.paused
    for _ in range(3):
        cart.page.handle_requests(cart.pacer, paused=True)
    assert cart.sim.time_ns == 151_000_000

    assert "0.100 s is not ahead" in (cart.ask(RunTo(100_000_000)) or "")
    assert "up to 1000.151 s" in (cart.ask(RunTo(2 * 10**12)) or "")


@pytest.mark.parametrize(
    ("what", "time_ns", "height"), [("all", 0, 1.0), ("poses", 500_000_000, 1.0), ("time", 0, None)]
)
def test_reset_of_time_poses_or_both(cart: Shown, what: Any, time_ns: int, height: float | None) -> None:
    cart.sim.run(0.5)
    fallen = cart.sim["cart"].link("wheel").pose.position[2]
    assert fallen < 0.0

    cart.ask(Reset(what))

    assert cart.sim.time_ns == time_ns
    assert cart.sim["cart"].link("wheel").pose.position[2] == pytest.approx(fallen if height is None else height)


def test_the_speed_is_set_and_unlimited(cart: Shown) -> None:
    cart.ask(SetSpeed(2.5))
    assert cart.pacer.speed == cart.server.states[-1].speed == 2.5
    cart.ask(SetSpeed(None))
    assert cart.pacer.speed is None


def test_joints_are_moved_and_unknown_ones_refused(cart: Shown) -> None:
    assert cart.ask(MoveJoint(model="cart", joint="axle", position=0.7)) is None
    cart.sim.run(3.0)
    assert cart.sim["cart"].joint("axle").position == pytest.approx(0.7, abs=0.01)

    assert "no joint 'knee'" in (cart.ask(MoveJoint(model="cart", joint="knee", velocity=1.0)) or "")
    assert "ball joint" in (cart.ask(MoveJoint(model="cart", joint="ball", position=1.0)) or "")


def test_a_joint_of_a_nested_model_is_moved(tmp_path: Path) -> None:
    shown = Shown(loaded(tmp_path, CART.replace('"cart"', '"m"').join(('<model name="outer">', "</model>")))[0])

    assert shown.ask(MoveJoint(model="outer::m", joint="axle", velocity=2.0)) is None
    shown.sim.run(0.1)

    assert shown.sim["outer"].joint("m::axle").velocity > 1.0
    assert "no joint 'm::none'" in (shown.ask(MoveJoint(model="outer::m", joint="none", position=1.0)) or "")


def test_bones_of_actors_follow_the_links_in_poses(tmp_path: Path) -> None:
    (tmp_path / "column.dae").write_text(bending_column())
    actor = """<actor name="bender"><skin><filename>column.dae</filename></skin><animation name="bend">
<filename>column.dae</filename></animation></actor>"""
    shown = Shown(loaded(tmp_path, model("floor") + actor)[0])

    shown.update(0.1)
    shown.sim.run(0.5)
    shown.update(0.1)

    (_, before), (_, after) = shown.server.poses[-2:]
    assert before.shape == (4, 7)
    moved = (before != after).any(axis=1)
    assert moved.tolist() == [False, False, True, True]
    file = next(file for file in shown.wait_world(1)["files"] if file["id"] == "bender")
    glb = Glb(shown.server.worlds[-1][1][file["url"]])
    assert [glb.nodes()[f"bender::bone {i}"]["extras"]["body"] for i in range(2)] == [2, 3]


def test_a_warning_is_shown_until_a_user_plays(cart: Shown) -> None:
    cart.page.warn("it is unstable")
    cart.ask(Pause())
    assert [text for _, text in cart.server.notices] == ["it is unstable"]
    cart.ask(Play())
    cart.ask(Play())
    assert [text for _, text in cart.server.notices] == ["it is unstable", None]


def test_unsupported_requests_are_refused(cart: Shown) -> None:
    assert (cart.ask(Reload()) or "").startswith("this world cannot be reloaded")
    assert cart.ask(Record(True)) == "this simulation does not support this request"
    assert cart.server.states[-1].recording is UNSET


def test_pictures_are_drawn_for_browsers_without_webgl(tmp_path: Path) -> None:
    """A red ball as the robot is in the middle of the picture; the world's background is at its edge."""
    ball = """<model name="ball"><link name="link"><visual name="v">
<geometry><sphere><radius>0.5</radius></sphere></geometry>
<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link></model>"""
    shown = Shown(loaded(tmp_path, ball)[0])
    number = shown.server.ask(RenderView(width=64, height=48, azimuth=0.3, elevation=0.4, distance=3.0))
    shown.page.handle_requests(shown.pacer, paused=True)

    answered, png = shown.server.pictures.get(timeout=60)
    rgb = np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=int)
    assert answered == number
    assert rgb.shape == (48, 64, 3)
    red, green, _ = rgb[24, 32]
    assert red > 60
    assert red > 4 * green
    assert rgb[1, 1].min() > 4 * rgb[24, 32].min()


_RED = "<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material>"
_BALL = f"""<model name="ball"><pose>9 0 0 0 0 0</pose><link name="link"><visual name="v">
<geometry><sphere><radius>0.5</radius></sphere></geometry>{_RED}</visual></link></model>"""
_CART_AT_ORIGIN = "<model name='cart'><link name='a'/><link name='b'/><joint name='j' type='revolute'>"
_CART_AT_ORIGIN += "<parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint></model>"


def _red_pixels(shown: Shown) -> int:
    shown.server.ask(RenderView(width=64, height=48, distance=3.0))
    shown.page.handle_requests(shown.pacer, paused=True)
    _, png = shown.server.pictures.get(timeout=60)
    red, green, _ = np.moveaxis(np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=int), -1, 0)
    return int((red > 2 * green + 20).sum())


def _edit(shown: Shown, action: Any) -> None:
    """Ask for an edit of the draft, and wait until it is shown."""
    count = len(shown.server.worlds)
    number = shown.server.ask(action)
    while number not in shown.server.answers or len(shown.server.worlds) == count:
        shown.page.handle_requests(shown.pacer, paused=True)
        time.sleep(0.001)
    assert shown.server.answers[number] is None


def test_the_edited_model_is_drawn_in_place_of_its_original(tmp_path: Path) -> None:
    """The robot is at the origin, out of whose picture the ball is; the picture of a draft is centered on the draft."""
    shown = Shown(loaded(tmp_path, _CART_AT_ORIGIN + _BALL)[0])
    shown.wait_world(1)
    assert _red_pixels(shown) == 0

    _edit(shown, BeginDraft(model="ball"))
    large = _red_pixels(shown)
    part, radius = next(
        (tuple(part["part"]), field["name"])
        for part in shown.server.worlds[-1][0]["draft"]["parts"]
        for section in part["sections"]
        for field in section["fields"]
        if field["name"].endswith("sphere/radius")
    )
    _edit(shown, SetField(part=part, field=radius, value=(0.2,)))
    small = _red_pixels(shown)
    assert 0 < small < large / 3

    _edit(shown, LeaveDraft())
    assert _red_pixels(shown) == 0


def test_a_world_that_cannot_be_drawn_has_a_reason(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Later pictures come."""
    shown = Shown(loaded(tmp_path, _BALL)[0])
    with monkeypatch.context() as broken:
        broken.setattr(pictures, "scene_from_world", lambda *_: 1 / 0)
        shown.server.ask(RenderView(width=64, height=48))
        shown.page.handle_requests(shown.pacer, paused=True)
        _, reason = shown.server.pictures.get(timeout=60)

    assert reason == "the world cannot be drawn: ZeroDivisionError: division by zero"
    assert _red_pixels(shown) > 0


def test_a_tall_robot_fits_into_pictures_of_any_aspect_ratio(tmp_path: Path) -> None:
    """The robot is a red pole of 1.6 m, whose first link is at its foot, like the RP2W's."""
    pole = """<model name="pole"><link name="foot"/><link name="mast"><pose>0 0 1.6 0 0 0</pose><visual name="v">
<pose>0 0 -0.8 0 0 0</pose><geometry><cylinder><radius>0.05</radius><length>1.6</length></cylinder></geometry>
<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link>
<joint name="j" type="fixed"><parent>foot</parent><child>mast</child></joint></model>"""
    shown = Shown(loaded(tmp_path, pole)[0])
    for width, height in ((320, 120), (120, 320)):
        shown.server.ask(RenderView(width=width, height=height))
        shown.page.handle_requests(shown.pacer, paused=True)
        _, png = shown.server.pictures.get(timeout=60)
        red, green, _ = np.moveaxis(np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=int), -1, 0)
        rows = np.flatnonzero((red > 2 * green).any(axis=1))

        assert rows[0] > height // 10
        assert rows[-1] < height * 9 // 10
        assert rows[-1] - rows[0] > min(width, height) // 4


def test_recording_is_started_and_shown(tmp_path: Path) -> None:
    class Recorder:
        since_ns: int | None = None

        def set(self, on: bool) -> None:
            self.since_ns = 7 if on else None

        def follow(self) -> None:
            raise AssertionError

    shown = Shown(loaded(tmp_path, CART)[0], recorder=Recorder())

    shown.ask(Record(True))
    assert shown.server.states[-1].recording.since_ns == 7
    shown.ask(Record(False))
    assert shown.server.states[-1].recording is None


def test_seeking_back_and_running_on_keeps_recording(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    sim = loaded(tmp_path, CART)[0]
    recording = PageRecording(sim, lambda _: None)
    shown = Shown(sim, recorder=recording, timeline=Timeline(sim))
    shown.ask(Step(50))
    shown.ask(MoveJoint(model="cart", joint="axle", velocity=2.0))
    shown.ask(Record(True))
    shown.ask(Step(100))
    poses, moved = sim.snapshot().poses, sim["cart"].joint("axle").position
    assert shown.server.states[-1].timeline == TimelineSpan(0, 150_000_000)

    assert shown.ask(Seek(20_000_000)) is None
    assert shown.paused
    assert (sim.steps, sim["cart"].joint("axle").position) == (20, 0.0)
    assert shown.server.states[-1].timeline == TimelineSpan(0, 150_000_000)
    shown.ask(Step(100))
    shown.ask(Step(30))
    assert sim["cart"].joint("axle").position == moved > 0.05
    assert np.array_equal(sim.snapshot().poses, poses)
    shown.ask(Record(False))

    times = read_state_log(next(tmp_path.rglob("state.log"))).times_s
    assert times[-1] == pytest.approx(0.15, abs=0.02)
    assert times.min() == pytest.approx(0.02, abs=0.02)  # recorded again from the time of the seek
    assert "not part of the timeline" in (shown.ask(Seek(10**12)) or "")


def test_an_edit_after_seeking_to_the_start_is_shown(tmp_path: Path) -> None:
    sim = loaded(tmp_path, CART)[0]
    shown = Shown(sim, timeline=Timeline(sim))
    shown.wait_world(1)
    shown.ask(Step(50))
    shown.ask(Seek(0))
    assert shown.ask(SetPhysics(wind=(0.0, 4.5, 0.0))) is None

    assert shown.wait_world(2)["physics"]["wind"] == [0.0, 4.5, 0.0]


def test_a_camera_is_drawn_only_while_it_is_watched(tmp_path: Path) -> None:
    sim, sensors = loaded(tmp_path, model("eye", CAMERA))
    shown = Shown(sim, sensors)
    shown.server.watched = set()
    sim.run(0.5)
    assert sensors[0].reading_count == 0

    shown.server.watched = {"/eye/l/cam/image_raw"}
    sim.run(0.5)

    assert {topic for topic, _, _ in shown.server.images} == shown.server.watched
    assert len(shown.server.images) == sensors[0].reading_count == 3
    assert shown.server.images[-1][2].shape == (6, 8, 3)


def test_lines_of_plugins_and_rays_have_names(tmp_path: Path) -> None:
    sim, sensors = loaded(tmp_path, model("eye", lidar()) + model("wall", BOX.replace("visual", "collision")))
    shown = Shown(sim, sensors)
    sim.lines["m::way"] = DebugLine(rgb=(1.0, 0.5, 0.0), points=[(0.0, 0.0, 0.0), (1.0, 2.0, 3.0)])
    sim.run(0.3)
    shown.update()

    path, rays = shown.server.lines[-1][1]
    assert (path.id, path.rgba) == ("m::way", (255, 128, 0, 255))
    assert path.points.tolist() == [[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]]
    assert rays.id == "eye::l::scan"
    shown.server.watched = {LINES}
    assert sim.lines_are_shown


def test_a_client_gets_the_world_its_files_poses_and_pictures(tmp_path: Path) -> None:
    sim, sensors = loaded(tmp_path, model("eye", CAMERA + BOX) + model("ball", BOX, static=False))
    shared = SharedPage(say=print, at=PageAddress(port=0))
    with (
        SimulationPage(shared, BareWorld(sim, sensors)) as page,
        ProtocolClient(str(shared.url)) as client,
    ):
        pacer = RealtimePacer(None)

        def run(until: Any) -> None:
            while not until():
                page.handle_requests(pacer, paused=False)
                sim.run(0.05)
                page.update(pacer, paused=False)
                client.read(0.01)

        for topic in ("trundle/world", "trundle/poses", "trundle/state"):
            client.subscribe(topic)
        run(lambda: client.payloads("trundle/world") and client.payloads("trundle/poses"))
        client.subscribe("/eye/l/cam/image_raw")
        run(lambda: client.payloads("/eye/l/cam/image_raw"))

        manifest = json.loads(client.payloads("trundle/world")[-1])
        for url in (*(file["url"] for file in manifest["files"]), *manifest["resources"]):
            with urlopen(page_url(str(shared.url), url)) as answer:
                content = answer.read()
            assert Glb(content).tree if url.endswith(".glb") else content

        client.send("trundle/request", id=1, request="pause")
        run(lambda: any(message.get("id") == 1 for message in client.jsons))
        assert {"op": "trundle/response", "id": 1, "ok": True} in client.jsons


def test_missing_meshes_are_named_in_a_notice(tmp_path: Path) -> None:
    visuals = "".join(
        f'<visual name="{name}"><geometry><mesh><uri>{name}</uri></mesh></geometry></visual>'
        for name in ("lost.stl", "gone.dae")
    )
    shown = Shown(loaded(tmp_path, model("m", visuals))[0])

    assert ("meshes", "2 meshes are missing: gone.dae, lost.stl") in shown.server.notices
