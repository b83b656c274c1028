"""Lines and pictures of sensors on the page, while models are added and removed."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from msgspec.structs import replace
from tests.page.simulated_world.fake_server import shared_page

import trundle
from trundle.page.ray_overlay import RayOverlay
from trundle.page.shown_world import BareWorld
from trundle.page.simulated_world.page import SimulationPage
from trundle.sim.realtime_pacer import RealtimePacer
from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import mount_cameras, mount_sensors
from trundle.sim.simulation import Simulation

_SCAN = """<ray><scan><horizontal><samples>{}</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle>
</horizontal></scan><range><min>0.1</min><max>9</max></range></ray>"""
_SONAR = "<sonar><min>0.1</min><max>5</max><radius>5</radius></sonar>"
_CAMERA = "<camera><image><width>8</width><height>6</height></image></camera>"
_WALL = """<model name="wall"><static>1</static><pose>3.5 0 0 0 0 0</pose><link name="l"><collision name="c"><geometry>
<box><size>1 20 20</size></box></geometry></collision></link></model>"""


def world(folder: Path, sensors: str) -> tuple[Simulation, list[Any]]:
    file = folder / "w.sdf"
    eye = f'<model name="eye"><static>1</static><pose>1 0 0 0 0 0</pose><link name="l">{sensors}</link></model>'
    file.write_text(f'<sdf version="1.6"><world name="w">{_WALL}{eye}</world></sdf>')
    sim = trundle.load(str(file))
    mounted = [*mount_cameras(sim, NativeRenderer), *mount_sensors(sim)]
    for one in mounted:
        sim.add_hook(one, period_ns=one.period_ns, enabled=one.enabled)
    return sim, mounted


def sensor(type_: str, inside: str, *, visualize: bool = True, turn: str = "0 0 0") -> str:
    """Return a sensor at 10 Hz."""
    shown = "<visualize>true</visualize>" if visualize else ""
    pose = f"<pose>0 0 0 {turn}</pose><update_rate>10</update_rate>"
    return f'<sensor name="{type_}" type="{type_}">{pose}{shown}{inside}</sensor>'


def test_rays_are_drawn_from_the_sensor_to_their_hits(tmp_path: Path) -> None:
    sim, mounted = world(tmp_path, sensor("ray", _SCAN.format(3)))
    sight = RayOverlay(lambda: True)
    sight.set_sensors(mounted)

    assert sight.lines(sim.snapshot()) == ()
    sim.run(0.1)
    (line,) = sight.lines(sim.snapshot())

    side = 2 * np.tan(0.5)
    ends = [(3, -side, 0), (3, 0, 0), (3, side, 0)]
    assert line.points[1::2] == pytest.approx(np.array(ends), abs=1e-4)
    assert line.points[0::2] == pytest.approx(np.array([(1, 0, 0)] * 3))


def test_some_of_many_rays_are_drawn_and_the_cone_of_a_sonar(tmp_path: Path) -> None:
    """A sonar looks along −z; after a quarter turn about y, along −x."""
    sonar = sensor("sonar", _SONAR, turn="0 -1.5707963 0")
    sim, mounted = world(tmp_path, sensor("ray", _SCAN.format(5000)) + sonar)
    sight = RayOverlay(lambda: True)
    sight.set_sensors(mounted)

    sim.run(0.1)
    by_count = sorted(sight.lines(sim.snapshot()), key=lambda line: len(line.points))

    cone, rays = by_count
    assert 60 < len(rays.points) // 2 <= 90
    assert cone.points[1::2, 0] == pytest.approx(1 + 2 * np.cos(np.pi / 4), abs=0.01)


def test_all_sensors_have_rays_and_hit_points(tmp_path: Path) -> None:
    """This includes sensors without <visualize>; ids have the kind as prefix."""
    scans = sensor("ray", _SCAN.format(3), visualize=False) + sensor("sonar", _SONAR, visualize=False)
    sim, mounted = world(tmp_path, scans)
    sight = RayOverlay(lambda: True, of_all=True)
    sight.set_sensors(mounted)

    sim.run(0.1)
    lines = {line.id: line for line in sight.lines(sim.snapshot())}

    assert set(lines) == {"rays eye::l::ray", "points eye::l::ray", "sonars eye::l::sonar"}
    assert lines["points eye::l::ray"].kind == "points"
    assert lines["points eye::l::ray"].points == pytest.approx(lines["rays eye::l::ray"].points[1::2])
    sight.set_sensors([])
    assert sight.lines(sim.snapshot()) == ()


def test_sensors_that_are_not_shown_are_not_listened_to(tmp_path: Path) -> None:
    sim, mounted = world(tmp_path, sensor("ray", _SCAN.format(3), visualize=False) + sensor("sonar", _SONAR))
    sight = RayOverlay(lambda: False)
    sight.set_sensors(mounted)

    sim.run(0.2)

    assert not any(listener.enabled() for listener in mounted)
    assert sight.lines(sim.snapshot()) == ()


def test_a_camera_is_sent_once_under_its_current_topic(tmp_path: Path) -> None:
    """The page gets all cameras again whenever a model is added or removed."""
    sim, (first,) = world(tmp_path, sensor("camera", _CAMERA))
    shared, server = shared_page()
    shown = BareWorld(sim, [first])
    page = SimulationPage(shared, shown)
    assert sim.lines_are_shown

    def show(*cameras: Any) -> None:
        shown.sensors = cameras
        page.update(RealtimePacer(None), paused=False, at_once=True)
        server.images.clear()
        sim.run(0.1)

    show(first)
    assert [topic for topic, _, _ in server.images] == ["/eye/l/camera/image_raw"]
    sim.spawn(replace(sim["eye"].model, name="other"))
    second = mount_cameras(sim, NativeRenderer, model="other", existing=[first])[0]
    sim.add_hook(second, period_ns=second.period_ns, enabled=second.enabled)
    show(first, second)
    assert sorted(topic for topic, _, _ in server.images) == ["/eye/l/camera/image_raw", "/other/l/camera/image_raw"]

    sim.delete("eye")
    show(second)
    assert [topic for topic, _, _ in server.images] == ["/other/l/camera/image_raw"]
