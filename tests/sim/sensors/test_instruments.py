"""Instruments against geometry and mechanics."""

import math
from pathlib import Path
from typing import TypeVar

import numpy as np
import pytest
from msgspec.structs import replace

import trundle
from trundle.robots.model import MEASURING
from trundle.sim.sensors import (
    ContactReading,
    ContactSensor,
    ForceTorqueReading,
    GpsReading,
    ImuReading,
    ImuSensor,
    RangeReading,
    RangeSensor,
    mount_sensors,
)
from trundle.sim.sensors.mount_instruments import MAKERS
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, Twist

BODY = "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"


def load(folder: Path, body: str, *, gravity: str = "0 0 -9.8", others: str = "", seed: int = 0) -> Simulation:
    file = folder / "w.sdf"
    model = f'<model name="m">{body}</model>'
    file.write_text(f'<sdf version="1.6"><world name="w"><gravity>{gravity}</gravity>{model}{others}</world></sdf>')
    return trundle.load(str(file), seed=seed)


Reading = TypeVar("Reading")


def read(sim: Simulation, seconds: float, kind: type[Reading]) -> list[Reading]:
    """Return all readings of a world's only sensor during some time [s]."""
    (sensor,) = mount_sensors(sim)
    readings: list[Reading] = []

    def add(reading: object) -> None:
        assert isinstance(reading, kind)
        readings.append(reading)

    sensor.listen(add)
    sensor.start(sim)
    sim.run(seconds)
    return readings


def imu(noise: str = "", pose: str = "0 0 0 0 0 0", rate: int = 100) -> str:
    pose = f"<pose>{pose}</pose><update_rate>{rate}</update_rate>"
    return f'<link name="a">{BODY}<sensor name="i" type="imu">{pose}<imu>{noise}</imu></sensor></link>'


def test_an_imu_at_rest_reads_g_upwards_in_its_own_frame(tmp_path: Path) -> None:
    """The model is fixed to the world; its imu is turned on its side."""
    still = '<joint name="j" type="fixed"><parent>world</parent><child>a</child></joint>'
    readings = read(load(tmp_path, imu(pose=f"0 0 0 {math.pi / 2} 0 0") + still), 1.0, ImuReading)

    assert len(readings) == 100
    assert readings[-1].linear_acceleration == pytest.approx((0, 9.8, 0), abs=1e-9)
    assert readings[-1].angular_velocity == pytest.approx((0, 0, 0), abs=1e-12)
    assert readings[-1].orientation == pytest.approx((1, 0, 0, 0))  # against its start


def test_an_imu_in_free_fall_reads_zero_acceleration(tmp_path: Path) -> None:
    readings = read(load(tmp_path, imu()), 0.5, ImuReading)

    assert readings[-1].linear_acceleration == pytest.approx((0, 0, 0), abs=1e-9)


@pytest.mark.parametrize("rate", [200, 10])
def test_an_imu_on_a_turning_platform_reads_rate_and_centripetal_acceleration(tmp_path: Path, rate: int) -> None:
    """Half a metre out at 2 rad/s: 2 m/s² towards the axis, in the frame that turns with it, at any rate."""
    sim = load(tmp_path, imu(pose="0.5 0 0 0 0 0", rate=rate), gravity="0 0 0")
    sim["m"].set_twist(Twist(angular=(0.0, 0.0, 2.0)))

    reading = read(sim, 1.0, ImuReading)[-1]

    assert reading.angular_velocity == pytest.approx((0, 0, 2), rel=5e-3)
    assert reading.linear_acceleration == pytest.approx((-2, 0, 0), abs=1e-2)


def test_an_imu_on_a_tumbling_falling_body_reads_centripetal_acceleration_only(tmp_path: Path) -> None:
    """The link's centre of mass is half a metre from it: ω² r = 4.5 m/s²."""
    body = imu(pose="-0.5 0 0 0 0 0", rate=20).replace("<mass>", "<pose>-1 0 0 0 0 0</pose><mass>")
    sim = load(tmp_path, body)
    sim["m"].set_twist(Twist(linear=(0.0, 0.0, 0.0), angular=(0.0, 3.0, 0.0)))

    assert read(sim, 0.5, ImuReading)[-1].linear_acceleration == pytest.approx((-4.5, 0, 0), abs=2e-2)


def test_noise_is_gaussian_and_repeats_with_the_seed(tmp_path: Path) -> None:
    still = '<joint name="j" type="fixed"><parent>world</parent><child>a</child></joint>'
    noise = "".join(
        f'<{axis}><noise type="gaussian"><mean>0.1</mean><stddev>0.5</stddev></noise></{axis}>' for axis in "xyz"
    )
    body = imu(f"<angular_velocity>{noise}</angular_velocity>", rate=1000) + still

    first, again, other = (
        [r.angular_velocity for r in read(load(tmp_path, body, seed=seed), 3.0, ImuReading)] for seed in (1, 1, 2)
    )

    assert first == again
    assert first != other
    assert np.mean(first) == pytest.approx(0.1, abs=0.02)
    assert np.std(first) == pytest.approx(0.5, abs=0.02)


def ray(horizontal: str, vertical: str = "", *, noise: str = "", type_: str = "ray") -> str:
    scan = (
        f"<scan><horizontal>{horizontal}</horizontal>{vertical}</scan><range><min>0.2</min><max>5</max></range>{noise}"
    )
    shape = '<collision name="own"><geometry><sphere><radius>0.3</radius></sphere></geometry></collision>'
    sensor = f'<sensor name="s" type="{type_}"><update_rate>10</update_rate><ray>{scan}</ray></sensor>'
    return f'<static>1</static><link name="a">{shape}{shape.replace("collision", "visual")}{sensor}</link>'


def obstacle(name: str, pose: str, shape: str, *, kinds: tuple[str, ...] = ("collision", "visual")) -> str:
    both = "".join(f'<{kind} name="c"><geometry>{shape}</geometry></{kind}>' for kind in kinds)
    return f'<model name="{name}"><static>1</static><pose>{pose}</pose><link name="l">{both}</link></model>'


WALL = obstacle("wall", "2 0 0 0 0 0", "<box><size>0.2 20 20</size></box>")


@pytest.mark.parametrize("type_", ["ray", "gpu_ray"])
def test_a_scan_measures_a_wall_exactly(tmp_path: Path, type_: str) -> None:
    """A wall 1.9 m ahead is 1.9 / cos(angle) away; beyond 5 m nothing is hit, nor is the sensor's own link."""
    fan = f"<samples>181</samples><min_angle>{-math.pi / 2}</min_angle><max_angle>{math.pi / 2}</max_angle>"
    reading = read(load(tmp_path, ray(fan, type_=type_), others=WALL), 0.1, RangeReading)[-1]

    (row,) = reading.ranges
    angles = np.linspace(-math.pi / 2, math.pi / 2, 181)
    wall = 1.9 / np.cos(angles)
    assert row[wall < 5.0] == pytest.approx(wall[wall < 5.0], abs=1e-5)
    assert np.isinf(row[wall > 5.0]).all()
    assert reading.time_ns == 100_000_000


AHEAD = "<samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle>"


@pytest.mark.parametrize(("type_", "expected"), [("ray", 3.0), ("lidar", 3.0), ("gpu_ray", 1.5), ("gpu_lidar", 1.5)])
def test_rays_hit_collisions_and_gpu_rays_hit_visuals(tmp_path: Path, type_: str, expected: float) -> None:
    cube = "<box><size>1 1 1</size></box>"
    others = obstacle("seen", "2 0 0 0 0 0", cube, kinds=("visual",))
    others += obstacle("touched", "3.5 0 0 0 0 0", cube, kinds=("collision",))

    reading = read(load(tmp_path, ray(AHEAD, type_=type_), others=others), 0.1, RangeReading)[-1]

    assert reading.ranges[0, 0] == pytest.approx(expected, abs=1e-5)


def test_resolution_multiplies_the_number_of_values(tmp_path: Path) -> None:
    """Five samples of resolution two: ten values over the same angles, exact where Gazebo interpolates."""
    fan = "<samples>5</samples><resolution>2</resolution><min_angle>-0.5</min_angle><max_angle>0.5</max_angle>"

    (row,) = read(load(tmp_path, ray(fan), others=WALL), 0.1, RangeReading)[-1].ranges

    assert row == pytest.approx(1.9 / np.cos(np.linspace(-0.5, 0.5, 10)), abs=1e-5)


def test_gpu_rays_start_at_the_minimum_range(tmp_path: Path) -> None:
    """A lidar in a housing of two links, both nearer than its 0.2 m; its own link is seen beyond that."""
    shell = obstacle("shell", "0.15 0 0 0 0 0", "<box><size>0.02 1 1</size></box>")
    inner = obstacle("inner", "0.1 0 0 0 0 0", "<box><size>0.02 1 1</size></box>")
    plate = (
        '<visual name="v"><pose>0 {} 0 0 0 0</pose><geometry><box><size>0.02 0.02 1</size></box></geometry></visual>'
    )
    mast = plate.replace("{}", "0.05") + plate.replace("{}", "0").replace("<pose>0", "<pose>0.05")
    fan = f"<samples>2</samples><min_angle>0</min_angle><max_angle>{math.pi / 2}</max_angle>"
    body = ray(fan, type_="gpu_ray").replace("</link>", mast + "</link>")

    ranges = read(load(tmp_path, body, others=shell + inner + WALL), 0.1, RangeReading)[-1].ranges

    assert ranges[0, 0] == pytest.approx(1.9, abs=1e-5)
    assert ranges[0, 1] == np.inf
    far = plate.replace("{}", "1").replace('"v"', '"w"')
    ranges = read(load(tmp_path, body.replace("</link>", far + "</link>"), others=WALL), 0.1, RangeReading)[-1].ranges
    assert ranges[0, 1] == np.inf  # the link is near: all of it is looked through


def test_gpu_rays_see_their_own_link(tmp_path: Path) -> None:
    far = '<visual name="v"><pose>1 0 0 0 0 0</pose><geometry><box><size>0.2 1 1</size></box></geometry></visual>'
    body = ray(AHEAD, type_="gpu_ray").replace("</link>", far + "</link>")

    assert read(load(tmp_path, body, others=WALL), 0.1, RangeReading)[-1].ranges[0, 0] == pytest.approx(0.9, abs=1e-5)


def test_collision_planes_are_infinite(tmp_path: Path) -> None:
    plane = "<plane><normal>-1 0 0</normal><size>1 1</size></plane>"
    fan = "<samples>2</samples><min_angle>0</min_angle><max_angle>0.7</max_angle>"
    wall = obstacle("wall", "2 0 0 0 0 0", plane)

    touched, visible = (
        read(load(tmp_path, ray(fan, type_=type_), others=wall), 0.1, RangeReading)[-1].ranges[0]
        for type_ in ("ray", "gpu_ray")
    )
    assert touched == pytest.approx([2.0, 2.0 / math.cos(0.7)], abs=1e-5)
    assert visible.tolist() == [pytest.approx(2.0, abs=1e-5), np.inf]


def test_rays_hit_models_spawned_later(tmp_path: Path) -> None:
    sim = load(tmp_path, ray(AHEAD), others=WALL)
    (sensor,) = mount_sensors(sim)
    assert isinstance(sensor, RangeSensor)
    assert sensor.measure(sim.snapshot()).ranges[0, 0] == pytest.approx(1.9, abs=1e-5)

    wall = sim["wall"].model
    sim.spawn(replace(wall, name="nearer", world_from_model=Pose((1.0, 0.0, 0.0))))
    assert sensor.measure(sim.snapshot()).ranges[0, 0] == pytest.approx(0.9, abs=1e-5)

    sim.delete("nearer")
    assert sensor.measure(sim.snapshot()).ranges[0, 0] == pytest.approx(1.9, abs=1e-5)


@pytest.mark.parametrize("type_", ["ray", "gpu_ray"])
def test_noise_keeps_ranges_within_the_limits(tmp_path: Path, type_: str) -> None:
    """As in Gazebo: a hit stays within the limits, and a miss has no noise."""
    wild = "<noise><type>gaussian</type><stddev>50</stddev></noise>"
    fan = "<samples>101</samples><min_angle>-1.2</min_angle><max_angle>1.2</max_angle>"
    (row,) = read(load(tmp_path, ray(fan, noise=wild, type_=type_), others=WALL), 0.1, RangeReading)[-1].ranges
    met = 1.9 / np.cos(np.linspace(-1.2, 1.2, 101)) < 5

    assert np.all(np.isinf(row[~met]))
    assert set(np.round(row[met], 6)) >= {0.2, 5.0}
    assert np.all((row[met] >= 0.2) & (row[met] <= 5.0))


def test_rows_of_rays_point_up_and_down(tmp_path: Path) -> None:
    ball = obstacle("ball", "3 0 0 0 0 0", "<sphere><radius>1</radius></sphere>")
    rows = "<vertical><samples>3</samples><min_angle>-0.6</min_angle><max_angle>0.6</max_angle></vertical>"
    one = "<samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle>"

    ranges = read(load(tmp_path, ray(one, rows), others=ball), 0.1, RangeReading)[-1].ranges

    assert ranges.shape == (3, 1)
    assert ranges[1, 0] == pytest.approx(2.0, abs=1e-5)
    assert np.isinf(ranges[[0, 2], 0]).all()


def test_hits_below_the_minimum_range_read_minus_infinity(tmp_path: Path) -> None:
    near = obstacle("near", "0.6 0 0 0 0 0", "<box><size>1 1 1</size></box>")
    one = "<samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle>"

    assert read(load(tmp_path, ray(one), others=near), 0.1, RangeReading)[-1].ranges[0, 0] == -np.inf


@pytest.mark.parametrize(("mask", "expected"), [("1", 1.9), ("2", 0.5)])
def test_a_gpu_lidar_hits_visuals_that_share_a_bit_with_its_mask(tmp_path: Path, mask: str, expected: float) -> None:
    near = obstacle("near", "1 0 0 0 0 0", "<box><size>1 1 1</size></box>", kinds=("visual",))
    near = near.replace("</visual>", "<visibility_flags>2</visibility_flags></visual>")
    beam = ray("<samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle>", type_="gpu_lidar").replace(
        "</ray>", f"<visibility_mask>{mask}</visibility_mask></ray>"
    )

    assert read(load(tmp_path, beam, others=near + WALL), 0.1, RangeReading)[-1].ranges[0, 0] == pytest.approx(
        expected, abs=1e-5
    )


def gps(position: str) -> str:
    return f'<static>1</static><link name="a"><pose>{position} 0 0 0</pose><sensor name="g" type="gps"/></link>'


@pytest.mark.parametrize(
    ("latitude", "longitude", "heading", "position", "expected"),
    [
        (0, 0, 0, "0 0 5", (0, 0, 5)),
        (0, 0, 0, "111319.4908 0 0", (0, 0.99990, 971.5)),
        (45, 7, 0, "0 1000 0", (45.0089987, 7, 0.0785)),
        (45, 7, 90, "1000 0 0", (45.0089987, 7, 0.0785)),
        (-33.9, 18.4, 0, "0 -500 10", (-33.9045074, 18.4, 10.0196)),
    ],
)
def test_a_fix_follows_the_tangent_plane(tmp_path: Path, latitude, longitude, heading, position, expected) -> None:
    """A degree of the equator is 111319.4908 m; a plane rises above the ellipsoid by d²/2R."""
    origin = (
        f"<latitude_deg>{latitude}</latitude_deg><longitude_deg>{longitude}</longitude_deg><elevation>0</elevation>"
    )
    origin = f"<spherical_coordinates>{origin}<heading_deg>{heading}</heading_deg></spherical_coordinates>"

    fix = read(load(tmp_path, gps(position), others=origin), 0.1, GpsReading)[-1]

    assert (fix.latitude_deg, fix.longitude_deg) == pytest.approx(expected[:2], abs=2e-6 if expected[2] < 500 else 2e-4)
    assert fix.altitude == pytest.approx(expected[2], abs=1e-3 if expected[2] < 500 else 1.0)


def test_a_bumper_measures_the_weight_on_its_collisions(tmp_path: Path) -> None:
    """A 2 kg cube stands on the floor: the floor's forces on it sum to 19.6 N upwards."""
    shape = "<geometry><box><size>0.2 0.2 0.2</size></box></geometry>"
    sensor = '<sensor name="b" type="contact"><contact><collision>m::a::foot</collision></contact></sensor>'
    body = BODY.replace("<mass>1</mass>", "<mass>2</mass>")
    link = f'<link name="a"><pose>0 0 0.1 0 0 0</pose>{body}<collision name="foot">{shape}</collision>{sensor}</link>'
    floor = obstacle("floor", "0 0 -0.5 0 0 0", "<box><size>9 9 1</size></box>")

    reading = read(load(tmp_path, link, others=floor), 1.0, ContactReading)[-1]

    assert {(touch.collision, touch.other) for touch in reading.contacts} == {("m::a::foot", "floor::l::c")}
    assert {touch.time_ns for touch in reading.contacts} == {reading.time_ns}
    assert sum(touch.wrench.force[2] for touch in reading.contacts) == pytest.approx(19.6, rel=5e-3)
    assert all(touch.normal == pytest.approx((0, 0, 1), abs=1e-9) for touch in reading.contacts)


BALL = """<link name="a"><pose>0 0 0.3 0 0 0</pose>{body}<collision name="c"><geometry>
<sphere><radius>0.1</radius></sphere></geometry><surface><bounce><restitution_coefficient>0.9</restitution_coefficient></bounce></surface></collision>
<sensor name="b" type="contact"><update_rate>{rate}</update_rate></sensor></link>"""
FLOOR = obstacle("floor", "0 0 -0.5 0 0 0", "<box><size>9 9 1</size></box>").replace(
    "</geometry>",
    "</geometry><surface><bounce><restitution_coefficient>1</restitution_coefficient><threshold>0</threshold></bounce>"
    "</surface>",
)


def touched(readings: list[ContactReading]) -> list[int]:
    """Times of the steps with contacts, from all readings."""
    return [time_ns for reading in readings for time_ns in dict.fromkeys(touch.time_ns for touch in reading.contacts)]


@pytest.mark.parametrize("rate", [1000, 30, 10])
def test_a_bumper_reports_every_step_since_its_last_reading(tmp_path: Path, rate: int) -> None:
    """A ball that bounces touches the floor for a step or two, hardly ever the one at which a slow sensor is due."""
    every = touched(read(load(tmp_path, BALL.format(body=BODY, rate=0), others=FLOOR), 2.0, ContactReading))
    assert 3 < len(every) < 200

    readings = read(load(tmp_path, BALL.format(body=BODY, rate=rate), others=FLOOR), 2.0, ContactReading)

    assert touched(readings) == [time_ns for time_ns in every if time_ns <= readings[-1].time_ns]
    assert all(0 <= r.time_ns - t.time_ns < 1e9 / rate for r in readings for t in r.contacts)


def test_a_slow_bumper_reports_the_last_hundred_steps(tmp_path: Path) -> None:
    (reading,) = read(
        load(tmp_path, BALL.format(body=BODY, rate=1).replace("0 0 0.3", "0 0 0.1"), others=FLOOR), 1.0, ContactReading
    )

    assert touched([reading]) == list(range(901_000_000, 1_001_000_000, 1_000_000))


def test_a_bumper_without_listeners_records_nothing(tmp_path: Path) -> None:
    """Contacts from before are not reported to a new listener, and meanwhile no step is checked."""
    sim = load(tmp_path, BALL.format(body=BODY, rate=10).replace("0 0 0.3", "0 0 0.1"), others=FLOOR)
    (bumper,) = mount_sensors(sim)
    assert isinstance(bumper, ContactSensor)
    readings: list[ContactReading] = []
    listens = True
    bumper.listen(readings.append, enabled=lambda: listens)
    bumper.start(sim)
    sim.run(0.55)
    listens = False
    assert not sim.is_recording
    sim.run(0.3)
    listens = True
    assert sim.is_recording
    sim.run(0.1)

    assert touched(readings[-1:]) == list(range(851_000_000, 901_000_000, 1_000_000))
    bumper.stop(sim)
    sim.run(0.1)
    assert len(readings) == 6


@pytest.mark.parametrize(
    ("settings", "force", "torque"),
    [
        ("", (0, 0, -19.6), (0, 9.8, 0)),
        ("<measure_direction>parent_to_child</measure_direction>", (0, 0, 19.6), (0, -9.8, 0)),
        ("<frame>sensor</frame>", (0, 19.6, 0), (0, 0, 9.8)),  # its y points down, its z along the hinge
        ("<frame>parent</frame>", (0, 0, -19.6), (0, 9.8, 0)),
    ],
)
def test_a_force_torque_sensor_measures_the_load_on_its_joint(tmp_path: Path, settings: str, force, torque) -> None:
    """2 kg half a metre out on a rigid arm: the child pulls its parent down and forward over its edge."""
    body = BODY.replace("<mass>1</mass>", "<mass>2</mass><pose>0.5 0 0 0 0 0</pose>")
    pose = f"<pose>0 0 0 {-math.pi / 2} 0 0</pose>"
    sensor = f'<sensor name="f" type="force_torque">{pose}<force_torque>{settings}</force_torque></sensor>'
    joint = f'<joint name="j" type="revolute"><parent>world</parent><child>a</child>{sensor}'
    joint += "<axis><xyz>0 1 0</xyz><limit><lower>-0.001</lower><upper>0.001</upper></limit></axis></joint>"

    wrench = read(load(tmp_path, f'<link name="a">{body}</link>{joint}'), 1.0, ForceTorqueReading)[-1].wrench

    assert wrench.force == pytest.approx(force, abs=0.1)
    assert wrench.torque == pytest.approx(torque, abs=0.1)


def test_a_sensor_without_listeners_is_disabled(tmp_path: Path) -> None:
    sim = load(tmp_path, ray("<samples>1</samples>") + imu().replace('"a"', '"b"'), others=WALL)
    sensors = mount_sensors(sim)

    assert [type(sensor) for sensor in sensors] == [RangeSensor, ImuSensor]
    assert not any(sensor.enabled() for sensor in sensors)


def test_measuring_types_equal_the_creatable_ones() -> None:
    assert set(MAKERS) == MEASURING - {"force_torque", "rfidtag", "wireless_transmitter"}
