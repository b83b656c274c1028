"""Instruments (sonars, barometers, magnetometers, radios, …), from the file to the messages."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import write_sdf, written_uri
from trundle.sim.sensors import AirPressureSensor, AltimeterSensor, ForceTorqueSensor, WirelessSensor, mount_sensors
from trundle.spatial import Twist, quaternion_from_rpy

MASS = "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"


def bot(sensor: str, *, pose: str = "0 0 0 0 0 0", static: int = 1, name: str = "bot") -> str:
    return (
        f'<model name="{name}"><static>{static}</static><pose>{pose}</pose><link name="l">{MASS}{sensor}</link></model>'
    )


def sensor(type_: str, inside: str = "", *, pose: str = "0 0 0 0 0 0", name: str = "s") -> str:
    rate = "<update_rate>20</update_rate>"
    return f'<sensor name="{name}" type="{type_}"><pose>{pose}</pose>{rate}{inside}</sensor>'


def box(name: str, position: str, *, size: str = "1 1 1", retro: float = 0.0) -> str:
    shape = f"<geometry><box><size>{size}</size></box></geometry><laser_retro>{retro}</laser_retro>"
    collision = f'<collision name="c">{shape}</collision>'
    return (
        f'<model name="{name}"><static>1</static><pose>{position} 0 0 0</pose><link name="l">{collision}</link></model>'
    )


def noise(stddev: float) -> str:
    return f'<noise type="gaussian"><stddev>{stddev}</stddev></noise>'


WANDERING = """<noise><dynamic_bias_stddev>0.2</dynamic_bias_stddev><precision>0.5</precision>
<dynamic_bias_correlation_time>3</dynamic_bias_correlation_time></noise>"""
FAR = "<range><max>9</max></range></ray>"
PINK = "<noise><type>pink</type></noise>"
SONAR = "<sonar><min>0.1</min><max>4</max><radius>1</radius></sonar>"


@pytest.mark.parametrize(
    ("position", "expected"),
    [("0 0 -3", 2.5), ("0 1.2 -3", math.hypot(2.8, 0.7)), ("0 4 -3", 4.0), ("0 0 -9", 4.0), ("0 0 3", 4.0)],
    ids=["below", "aside, in the cone", "aside, out of it", "too far", "above"],
)
def test_a_sonar_measures_down_its_z_axis(receive: Any, position: str, expected: float) -> None:
    """The target is a cube of 1 m; the cone's radius is 1 m at 4 m, and 0.7 m, the edge of a cube aside, at 2.8 m."""
    topic = "/bot/l/s/range"
    world = bot(sensor("sonar", SONAR)) + box("cube", position)
    received, frames = receive(world, {topic: "sensor_msgs/Range"})

    message = received[topic]
    assert message.range == pytest.approx(expected, abs=0.03)
    assert (message.min_range, message.max_range) == pytest.approx((0.1, 4.0))
    assert message.field_of_view == pytest.approx(2 * math.atan(0.25))
    assert message.header.frame_id == "bot/s"
    assert "bot/s" in frames


def test_a_magnetometer_measures_the_worlds_field_along_its_axes(receive: Any) -> None:
    topic = "/bot/l/s/magnetic_field"
    field = "<magnetic_field>1e-5 2e-5 -4e-5</magnetic_field>"
    magnetometer = sensor("magnetometer", pose=f"0 0 0 0 0 {math.pi / 2}")
    received, frames = receive(field + bot(magnetometer), {topic: "sensor_msgs/MagneticField"})

    measured = received[topic].magnetic_field
    assert (measured.x, measured.y, measured.z) == pytest.approx((2e-5, -1e-5, -4e-5), abs=1e-12)
    assert received[topic].header.frame_id in frames


def test_an_altimeter_measures_height_above_its_start_and_vertical_velocity(receive: Any) -> None:
    """Free fall from 7 m for 0.05 s."""
    topics = {
        "/bot/l/s/altitude": "geometry_msgs/Vector3Stamped",
        "/bot/l/s/vertical_velocity": "geometry_msgs/Vector3Stamped",
    }
    received, _ = receive(bot(sensor("altimeter"), pose="0 0 7 0 0 0", static=0), topics)

    height, speed = (received[topic].vector.z for topic in topics)
    assert height == pytest.approx(-0.5 * 9.8 * 0.05**2, rel=0.03)
    assert speed == pytest.approx(-9.8 * 0.05, rel=0.01)


def test_a_barometer_measures_the_standard_atmosphere(receive: Any) -> None:
    """ISA: 89874.6 Pa at 1000 m."""
    topic = "/bot/l/s/air_pressure"
    inside = (
        f"<air_pressure><reference_altitude>900</reference_altitude><pressure>{noise(0.0)}</pressure></air_pressure>"
    )
    received, frames = receive(
        bot(sensor("air_pressure", inside), pose="0 0 100 0 0 0"), {topic: "sensor_msgs/FluidPressure"}
    )

    assert received[topic].fluid_pressure == pytest.approx(89876.3, abs=0.5)
    assert received[topic].header.frame_id in frames


def test_an_air_speed_sensor_measures_dynamic_pressure(receive: Any) -> None:
    """At rest in a head wind of 10 m/s: ρ v² / 2 with air of 1.225 kg/m³."""
    topic = "/bot/l/s/air_speed"
    wind = "<wind><linear_velocity>-10 3 0</linear_velocity></wind>"
    received, _ = receive(wind + bot(sensor("air_speed")), {topic: "sensor_msgs/FluidPressure"})

    assert received[topic].fluid_pressure == pytest.approx(0.5 * 1.225 * 100, rel=1e-3)


@pytest.mark.parametrize(("pitch", "is_visible"), [(0.0, True), (-0.4, True), (-math.pi / 2, False)])
def test_a_logical_camera_sees_the_ground_plane_unless_it_looks_straight_up(
    receive: Any, pitch: float, is_visible: bool
) -> None:
    settings = "<logical_camera><near>0.5</near><far>6</far><horizontal_fov>1</horizontal_fov></logical_camera>"
    camera = sensor("logical_camera", settings, pose=f"0 0 1 0 {pitch} 0")
    plane = "<geometry><plane><normal>0 0 1</normal></plane></geometry>"
    link = f'<link name="l"><collision name="c">{plane}</collision></link>'
    topic = "/bot/l/s/models"
    received, _ = receive(
        bot(camera) + f'<model name="ground"><static>1</static>{link}</model>', {topic: "tf2_msgs/TFMessage"}
    )

    assert [t.child_frame_id for t in received[topic].transforms] == ["ground"] * is_visible


def test_a_logical_camera_publishes_poses_of_models_in_its_frustum(receive: Any) -> None:
    """Models are ahead, partly inside, outside and too far; the sensor's own model is never included."""
    settings = "<logical_camera><near>0.5</near><far>6</far><horizontal_fov>1</horizontal_fov></logical_camera>"
    camera = sensor("logical_camera", settings, pose=f"0 0 1 0 0 {math.pi / 2}")
    models = box("ahead", "0 3 1.2") + box("rim", "2 3 1") + box("aside", "3 3 1") + box("far", "0 9 1")
    topic = "/bot/l/s/models"
    received, frames = receive(bot(camera) + models, {topic: "tf2_msgs/TFMessage"})

    transforms = {t.child_frame_id: t.transform for t in received[topic].transforms}
    assert set(transforms) == {"ahead", "rim"}
    translation = transforms["ahead"].translation
    assert (translation.x, translation.y, translation.z) == pytest.approx((3, 0, 0.2), abs=1e-9)
    assert transforms["ahead"].rotation.z == pytest.approx(-math.sqrt(0.5))
    assert {t.header.frame_id for t in received[topic].transforms} == {"bot/s"} <= frames


RADIO = "<transceiver><essid>{}</essid><frequency>2442</frequency><gain>3</gain><power>{}</power></transceiver>"


def levels(message: Any) -> dict[str, float]:
    return {status.name: float(status.values[1].value) for status in message.status}


@pytest.mark.parametrize("wall", [False, True])
def test_a_receiver_lists_transmitters_with_gazebos_signal_levels(receive: Any, wall: bool) -> None:
    """Power and gains minus the free-space loss at 1 m, 60 dB per decade (120 behind a wall) and a random loss."""
    near = sensor("wireless_transmitter", RADIO.format("near", 40))
    receiver = sensor("wireless_receiver", "<transceiver><gain>2</gain><sensitivity>-200</sensitivity></transceiver>")
    other = sensor("wireless_transmitter", RADIO.format("other", 40).replace("2442", "5000"))
    world = bot(receiver) + bot(near, name="tx", pose="10 0 0 0 0 0") + bot(other, name="tx5", pose="3 0 0 0 0 0")
    topic = "/bot/l/s/nodes"
    barrier = box("wall", "5 0 0") if wall else ""
    received, frames = receive(world + barrier, {topic: "diagnostic_msgs/DiagnosticArray"})

    (level,) = levels(received[topic]).values()
    assert levels(received[topic]).keys() == {"near"}
    free_space = 20 * math.log10(299_792_458 / 2442e6 / (4 * math.pi))
    max_level = 40 + 3 + 2 + free_space - (120 if wall else 60)
    assert max_level - 30 <= level <= max_level  # five deviations of the random loss
    assert received[topic].header.frame_id in frames


def test_a_receiver_omits_signals_below_its_sensitivity(load_world: Any) -> None:
    receiver = sensor("wireless_receiver", "<transceiver><sensitivity>0</sensitivity></transceiver>")
    transmitter = bot(sensor("wireless_transmitter"), name="tx", pose="30 0 0 0 0 0")
    sim = load_world(bot(receiver) + transmitter)
    (mounted,) = mount_sensors(sim)

    assert isinstance(mounted, WirelessSensor)
    assert mounted.measure(sim.snapshot()).signals == ()


def test_an_rfid_sensor_lists_the_tags_within_five_metres(receive: Any) -> None:
    tags = "".join(bot(sensor("rfidtag", name="t"), name=f"tag{x}", pose=f"{x} 0 0 0 0 0") for x in (1, 4, 6))
    topic = "/bot/l/s/tags"
    received, _ = receive(bot(sensor("rfid")) + tags, {topic: "diagnostic_msgs/DiagnosticArray"})

    assert [status.name for status in received[topic].status] == ["tag1::l::t", "tag4::l::t"]


UP = "<localization>GRAV_UP</localization>"


@pytest.mark.parametrize(
    ("reference", "expected"),
    [
        ("", (0, 0, 0)),
        ("<localization>ENU</localization>", (0, 0, 0.3 + math.radians(30))),
        ("<localization>NED</localization>", (math.pi, 0, math.pi / 2 - 0.3 - math.radians(30))),
        ("<localization>NWU</localization>", (0, 0, 0.3 + math.radians(30) - math.pi / 2)),
        ("<localization>CUSTOM</localization>", (0, 0, 0)),
        ('<localization>CUSTOM</localization><custom_rpy parent_frame="world">0 0 0.1</custom_rpy>', (0, 0, 0.2)),
        ("<localization>CUSTOM</localization><custom_rpy>0 0 0.1</custom_rpy>", (0, 0, -0.1)),
        (
            '<localization>GRAV_UP</localization><grav_dir_x parent_frame="world">0 1 5</grav_dir_x>',
            (0, 0, 0.3 - math.pi / 2),
        ),
        (UP, (0, 0, 0)),
        ("<localization>GRAV_DOWN</localization>", (math.pi, 0, 0)),
    ],
)
def test_an_imu_publishes_its_orientation_in_its_reference_frame(
    receive: Any, reference: str, expected: tuple[float, float, float]
) -> None:
    """The world's x axis is 30 degrees north of east, the imu's is 0.3 rad further."""
    if reference:
        reference = f"<orientation_reference_frame>{reference}</orientation_reference_frame>"
    location = "<spherical_coordinates><heading_deg>30</heading_deg></spherical_coordinates>"
    topic = "/bot/l/s/imu"
    imu = sensor("imu", f"<imu>{reference}</imu>")
    received, _ = receive(location + bot(imu, pose="0 0 0 0 0 0.3"), {topic: "sensor_msgs/Imu"})

    q = received[topic].orientation
    w, x, y, z = quaternion_from_rpy(*expected)
    assert abs(q.w * w + q.x * x + q.y * y + q.z * z) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("rows", [1, 3])
def test_rays_publish_the_laser_retro_of_surfaces(receive: Any, rows: int) -> None:
    scan = "<scan><horizontal><samples>3</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle></horizontal>"
    scan += f"<vertical><samples>{rows}</samples><min_angle>0</min_angle><max_angle>0</max_angle></vertical></scan>"
    lidar = sensor("ray", f"<ray>{scan}<range><min>0.1</min><max>9</max></range></ray>")
    world = bot(lidar) + box("bright", "4 0 0", retro=250) + box("dull", "4 2.2 0")
    topic, type_ = ("/bot/l/s/scan", "LaserScan") if rows == 1 else ("/bot/l/s/points", "PointCloud2")
    received, _ = receive(world, {topic: f"sensor_msgs/{type_}"})

    message = received[topic]
    if rows == 1:
        assert list(message.intensities) == [0, 250, 0]
        assert np.isfinite(message.ranges[1:]).all()
    else:
        points = np.frombuffer(message.data.tobytes(), dtype="<f4").reshape(-1, message.point_step // 4)
        assert [field.name for field in message.fields] == ["x", "y", "z", "intensity"]
        assert sorted(points[:, 3].tolist()) == [0, 0, 0, 250, 250, 250]


def test_a_force_torque_sensor_has_noise_on_each_axis(load_world: Any) -> None:
    settings = f"<force><x>{noise(2.0)}</x></force><torque><z>{noise(0.5)}</z></torque>"
    force_torque = f'<sensor name="f" type="force_torque"><force_torque>{settings}</force_torque></sensor>'
    joint = f'<joint name="j" type="fixed"><parent>world</parent><child>l</child>{force_torque}</joint>'
    sim = load_world(f'<model name="bot"><link name="l">{MASS}</link>{joint}</model>')
    (mounted,) = mount_sensors(sim)
    assert isinstance(mounted, ForceTorqueSensor)
    sim.run(0.01)

    wrenches = [mounted.measure(sim.snapshot()).wrench for _ in range(400)]
    spread = np.std([[*w.force, *w.torque] for w in wrenches], axis=0)
    assert spread[[0, 5]] == pytest.approx([2.0, 0.5], rel=0.15)
    assert spread[[1, 2, 3, 4]] == pytest.approx([0, 0, 0, 0], abs=1e-9)


@pytest.mark.parametrize(
    ("type_", "inside", "sentence"),
    [
        ("sonar", "<sonar><min>2</min><max>1</max></sonar>", "a sonar from 2 to 1 m of radius 0.5 m is not possible"),
        (
            "ray",
            "<ray><scan><horizontal><resolution>-2</resolution></horizontal></scan><range><max>1</max></range></ray>",
            "a resolution of -2 values per sample is not possible; 1 is used",
        ),
        (
            "ray",
            "<ray><scan><horizontal><samples>0</samples></horizontal></scan>" + FAR,
            "0 samples is not possible; 1 is used",
        ),
        ("ray", f"<ray>{PINK}{FAR}", "no noise type 'pink': gaussian, gaussian_quantized, custom, none; none is used"),
        ("ray", f"<ray><noise><precision>-1</precision></noise>{FAR}", "a precision of -1 is not possible"),
        ("contact", "<contact><collision>b_m::l::nobody</collision></contact>", "no collision 'nobody' on link 'l';"),
        (
            "ray",
            f"<ray><noise><mean>1e17</mean></noise>{FAR}",
            "noise with a mean of 1e+17 is not possible; 0 is used",
        ),
        ("sonar", "<sonar><geometry>cube</geometry></sonar>", "no sonar geometry 'cube': cone or sphere; cone is used"),
        ("logical_camera", "<logical_camera><near>3</near></logical_camera>", "near 3, far 1 is not possible"),
        (
            "logical_camera",
            "<logical_camera><horizontal_fov>4</horizontal_fov></logical_camera>",
            "horizontal_fov 4 rad with aspect_ratio 1 is not possible; 1 and 1 are used",
        ),
        ("wireless_receiver", "<transceiver><frequency>-3</frequency></transceiver>", "a frequency of -3 MHz"),
        (
            "imu",
            "<imu><orientation_reference_frame><localization>UP</localization></orientation_reference_frame></imu>",
            "no localization 'UP': CUSTOM, ENU, NED, NWU, GRAV_UP, GRAV_DOWN; the orientation is relative to the start",
        ),
    ],
)
def test_impossible_settings_are_replaced_with_a_warning(
    load_world: Any, type_: str, inside: str, sentence: str
) -> None:
    sim = load_world(bot(sensor(type_, inside)))
    (mounted,) = mount_sensors(sim)

    assert mounted.measure(sim.snapshot()).time_ns == 0
    (warning,) = sim.report.warnings
    assert "w.sdf:1: warning: " in warning
    assert sentence in warning


def test_a_force_torque_sensor_on_a_link_is_reported_as_not_simulated(load_world: Any) -> None:
    sim = load_world(bot(sensor("force_torque")))

    assert mount_sensors(sim) == []
    (warning,) = sim.report.warnings
    assert warning.endswith("sensor 's': force_torque sensors measure joints; not simulated on a link")


def test_an_unknown_measure_direction_is_reported(load_world: Any) -> None:
    settings = "<force_torque><measure_direction>up</measure_direction></force_torque>"
    joint = f"<parent>world</parent><child>l</child>{sensor('force_torque', settings)}"
    sim = load_world(f'<model name="m"><link name="l"/><joint name="j" type="fixed">{joint}</joint></model>')

    (warning,) = sim.report.warnings
    assert warning.endswith("no measure_direction 'up': child_to_parent or parent_to_child; child_to_parent is used")


@pytest.mark.parametrize(
    ("air", "height", "expected"),
    [
        ("<temperature>0</temperature>", "0", 101325.0),
        ("<temperature>1e300</temperature>", "0", 101325.0),
        ("<pressure>-4</pressure>", "0", 101325.0),
        (
            "<temperature>1</temperature><temperature_gradient>-1e-9</temperature_gradient>",
            "-1e6",
            101325.0 * math.exp(100),
        ),
        (
            "<temperature_gradient>1e300</temperature_gradient>",
            "1e300",
            101325.0,
        ),  # so high that the earth's radius matters
    ],
)
def test_impossible_air_gives_a_finite_pressure(load_world: Any, air: str, height: str, expected: float) -> None:
    settings = f"<air_pressure><reference_altitude>{height}</reference_altitude></air_pressure>"
    sim = load_world(f"<atmosphere>{air}</atmosphere>" + bot(sensor("air_pressure", settings)))
    (barometer,) = mount_sensors(sim)

    assert isinstance(barometer, AirPressureSensor)
    assert barometer.measure(sim.snapshot()).pressure == pytest.approx(expected)


def test_settings_survive_writing_and_reading(load_world: Any) -> None:
    quiet = f"<x>{noise(1.0)}</x>"
    inner = [
        sensor("sonar", SONAR, name="a"),
        sensor("magnetometer", f"<magnetometer>{quiet}</magnetometer>", name="b"),
        sensor("altimeter", f"<altimeter><vertical_velocity>{noise(1)}</vertical_velocity></altimeter>", name="c"),
        sensor("air_pressure", "<air_pressure><reference_altitude>9</reference_altitude></air_pressure>", name="d"),
        sensor("air_speed", f"<air_speed><pressure>{WANDERING}</pressure></air_speed>", name="e"),
        sensor("logical_camera", "<logical_camera><far>7</far></logical_camera>", name="f"),
        sensor("wireless_receiver", "<transceiver><gain>9</gain></transceiver>", name="g"),
        sensor("rfidtag", name="h"),
    ]
    named = "<localization>NED</localization><custom_rpy parent_frame='world'>1 2 3</custom_rpy>"
    inner.append(
        sensor("imu", f"<imu><orientation_reference_frame>{named}</orientation_reference_frame></imu>", name="i")
    )
    sim = load_world(bot("".join(inner)))
    original = sim.world.models[0].links[0].sensors
    report = Diagnostics()
    text = write_sdf(sim.world, is_world=True, uri_of=written_uri, report=report)
    content = text.partition("<world")[2].partition(">")[2].rpartition("</world>")[0]
    reread = load_world(content).world.models[0].links[0].sensors

    assert [(s.instrument, s.imu) for s in reread] == [(s.instrument, s.imu) for s in original]
    assert report.warnings == []


def test_a_sensors_velocity_is_that_of_its_position(load_world: Any) -> None:
    """Half a metre from the axis of a link that rotates at 2 rad/s: 1 m/s upwards."""
    sim = load_world("<gravity>0 0 0</gravity>" + bot(sensor("altimeter", pose="0.5 0 0 0 0 0"), static=0))
    sim["bot"].set_twist(Twist(angular=(0.0, -2.0, 0.0)))
    (altimeter,) = mount_sensors(sim)

    assert isinstance(altimeter, AltimeterSensor)
    assert altimeter.measure(sim.snapshot()).velocity == pytest.approx(1.0)
