"""Cameras and sensors by name: what they see of a scene whose measures are known."""

import io
import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import trundle
from trundle.base.diagnostics import UsageError
from trundle.sim.sensors import ContactReading, ImuReading, RangeReading
from trundle.spatial import Pose

_CAMERA = """<camera><horizontal_fov>1.0</horizontal_fov><image><width>200</width><height>100</height></image>
<clip><near>0.05</near><far>50</far></clip>{noise}</camera>"""
_NOISE = "<noise><type>gaussian</type><mean>0</mean><stddev>0.1</stddev></noise>"
_RAY = """<ray><scan><horizontal><samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle></horizontal>
</scan><range><min>0.1</min><max>20</max></range></ray>"""
WORLD = f"""<sdf version="1.6"><world name="w"><gravity>0 0 -10</gravity>
<model name="robot"><pose>0 0 1 0 0 0</pose><static>true</static><link name="head">
<sensor name="eye" type="camera">{_CAMERA.format(noise=_NOISE)}</sensor>
<sensor name="lidar" type="ray">{_RAY}</sensor></link>
<link name="tail"><pose>0 0 0 0 0 3.14159265</pose><sensor name="eye" type="camera">{_CAMERA.format(noise="")}</sensor>
</link></model>
<model name="wall"><static>true</static><pose>3 0 1 0 0 0</pose><link name="brick"><visual name="red"><geometry>
<box><size>1 0.5 0.4</size></box></geometry></visual><collision name="c"><geometry><box><size>1 0.5 0.4</size></box>
</geometry></collision></link></model>
<model name="floor"><static>true</static><pose>0 0 -20 0 0 0</pose><link name="f"><collision name="c"><geometry>
<plane/></geometry></collision></link></model>
<model name="rider"><pose>9 9 -19.5 0 0 0</pose><link name="body"><collision name="hull"><geometry><box>
<size>1 1 1</size></box></geometry></collision>
<sensor name="imu" type="imu"><update_rate>100</update_rate></sensor>
<sensor name="bumper" type="contact"><contact><collision>hull</collision></contact><update_rate>50</update_rate>
</sensor>
</link></model></world></sdf>"""


@pytest.fixture
def sim(tmp_path: Path):
    file = tmp_path / "w.world"
    file.write_text(WORLD)
    return trundle.load(file)


def test_a_camera_renders_color_depth_and_segmentation(sim) -> None:
    """A wall 0.5 m wide and 0.4 m high, 2.5 m ahead, through f = 100 px / tan 0.5."""
    image = sim.camera("head::eye").render()

    focal = 100 / math.tan(0.5)
    mask = image.mask("wall")
    assert (image.rgb.shape, image.rgb.dtype) == ((100, 200, 3), np.uint8)
    assert image.depth is not None
    assert image.depth[50, 100] == pytest.approx(2.5, abs=1e-5)
    assert image.depth[mask].min() == pytest.approx(image.depth[mask].max(), abs=1e-5)
    assert np.isinf(image.depth[~mask]).all()
    assert mask.sum() == pytest.approx(focal * 0.5 / 2.5 * focal * 0.4 / 2.5, rel=0.07)
    assert image.names[image.segmentation[50, 100]] == "wall::brick::red"
    assert image.names[image.segmentation[0, 0]] == ""
    assert repr(image) == "<CameraImage 200x100 at 0.000 s: 1 visuals seen>"


def test_a_render_has_no_noise_but_a_reading_does(sim) -> None:
    clean, again = (sim.camera("head::eye").render().rgb for _ in range(2))

    assert (clean == again).all()
    noisy = sim.sensor("head::eye").read().rgb
    assert np.std(noisy.astype(float) - clean) > 5.0


def test_a_render_shows_the_current_state(sim) -> None:
    camera = sim.camera("head::eye")
    sim["wall"].set_pose(Pose((5.0, 0.0, 1.0)))
    assert camera.render().depth[50, 100] == pytest.approx(4.5, abs=1e-5)


def test_notebooks_show_the_rendered_image(sim) -> None:
    image = sim.camera("head::eye").render()

    assert (np.asarray(Image.open(io.BytesIO(image._repr_png_()))) == image.rgb).all()


def test_an_unknown_mask_name_is_refused_with_the_existing_names(sim) -> None:
    image = sim.camera("head::eye").render()

    assert (image.mask("wall::brick") == image.mask("wall::brick::red")).all()
    with pytest.raises(UsageError, match=r"nothing is called 'wal'; there are: 'wall::brick::red'"):
        image.mask("wal")


@pytest.mark.parametrize(
    ("kind", "name", "says"),
    [
        ("camera", "nose", "no camera 'nose'; there are: 'robot::head::eye', 'robot::tail::eye'"),
        ("camera", "eye", "several cameras are called 'eye'; write one of 'robot::head::eye', 'robot::tail::eye'"),
        ("camera", "lidar", "no camera 'lidar'; there are: 'robot::head::eye', 'robot::tail::eye'"),
        ("sensor", "ead::eye", "no sensor 'ead::eye'; there are: 'robot::head::eye', 'robot::tail::eye', 'robot::head"),
    ],
)
def test_unknown_and_ambiguous_sensor_names_are_refused_with_the_names(sim, kind, name, says) -> None:
    with pytest.raises(UsageError) as caught:
        getattr(sim, kind)(name)
    assert str(caught.value).startswith(says)


def test_sensors_are_found_by_the_end_of_their_name(sim) -> None:
    assert sim.sensor("lidar").name == "robot::head::lidar"
    assert repr(sim.sensor("head::lidar")) == "<SensorHandle 'robot::head::lidar': ray>"
    assert sim.camera_names == ("robot::head::eye", "robot::tail::eye")
    assert set(sim.sensor_names) == {*sim.camera_names, "robot::head::lidar", "rider::body::imu", "rider::body::bumper"}


def test_a_sensor_reads_the_current_state(sim) -> None:
    scan = sim.sensor("lidar").read()

    assert isinstance(scan, RangeReading)
    assert scan.ranges[0, 0] == pytest.approx(2.5)
    sim["wall"].set_pose(Pose((7.0, 0.0, 1.0)))
    assert sim.sensor("lidar").read().ranges[0, 0] == pytest.approx(6.5)


def test_an_imu_measures_at_its_rate_from_its_first_lookup_on(sim) -> None:
    """In free fall it reads zero, on the floor the supporting acceleration."""
    sim["rider"].set_pose(Pose((9.0, 9.0, 10.0)))
    imu = sim.sensor("imu")
    sim.run(0.505)
    falling = imu.read()
    assert isinstance(falling, ImuReading)
    assert falling.time_ns == 500_000_000
    assert falling.linear_acceleration == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)

    sim.reset()
    assert imu.read().time_ns == 0
    sim.run(2.0)
    assert imu.read().linear_acceleration == pytest.approx((0.0, 0.0, 10.0), abs=1e-3)


def test_a_bumper_reports_the_contacts_of_its_period(sim) -> None:
    bumper = sim.sensor("bumper")
    sim.run(1.0)

    reading = bumper.read()
    assert isinstance(reading, ContactReading)
    assert {touch.other for touch in reading.contacts} == {"floor::f::c"}
    assert {touch.time_ns for touch in reading.contacts} == set(range(981_000_000, 1_000_000_001, 1_000_000))


def test_sensors_come_and_go_with_their_models(sim) -> None:
    sim.spawn(sim["robot"].model, allow_renaming=True)
    assert "robot_0::head::lidar" in sim.sensor_names
    sim.rename("robot_0", "other")
    assert sim.sensor("other::head::lidar").read().ranges[0, 0] == pytest.approx(2.5)
    sim.delete("other")
    assert sim.sensor("lidar").name == "robot::head::lidar"
