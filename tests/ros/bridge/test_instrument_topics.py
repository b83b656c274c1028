"""Instruments (sonars, barometers, magnetometers, radios, …), from the file to their messages."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import write_sdf, written_uri
from trundle.sim.sensors import mount_sensors
from trundle.spatial import Twist, quaternion_from_rpy

MASS = "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"


def bot(sensor: str, *, pose: str = "0 0 0 0 0 0", static: int = 1, name: str = "bot") -> str:
    return (
        f'<model name="{name}"><static>{static}</static><pose>{pose}</pose><link name="l">{MASS}{sensor}</link></model>'
    )


def sensor(type_: str, inside: str = "", *, pose: str = "0 0 0 0 0 0", name: str = "s") -> str:
    rate = "<update_rate>20</update_rate>"
    return f'<sensor name="{name}" type="{type_}"><pose>{pose}</pose>{rate}{inside}</sensor>'


def box(name: str, place: str, *, size: str = "1 1 1", retro: float = 0.0) -> str:
    shape = f"<geometry><box><size>{size}</size></box></geometry><laser_retro>{retro}</laser_retro>"
    collision = f'<collision name="c">{shape}</collision>'
    return f'<model name="{name}"><static>1</static><pose>{place} 0 0 0</pose><link name="l">{collision}</link></model>'


def noise(stddev: float) -> str:
    return f'<noise type="gaussian"><stddev>{stddev}</stddev></noise>'


WANDERING = """<noise><dynamic_bias_stddev>0.2</dynamic_bias_stddev><precision>0.5</precision>
<dynamic_bias_correlation_time>3</dynamic_bias_correlation_time></noise>"""
FAR = "<range><max>9</max></range></ray>"
PINK = "<noise><type>pink</type></noise>"
SONAR = "<sonar><min>0.1</min><max>4</max><radius>1</radius></sonar>"


@pytest.mark.parametrize(
    ("place", "expected"),
    [("0 0 -3", 2.5), ("0 1.2 -3", math.hypot(2.8, 0.7)), ("0 4 -3", 4.0), ("0 0 -9", 4.0), ("0 0 3", 4.0)],
    ids=["below", "aside, in the cone", "aside, out of it", "too far", "above"],
)
def test_a_sonar_listens_down_its_z_axis(hear: Any, place: str, expected: float) -> None:
    """A cube of one metre; the cone's radius is 1 m at 4 m, and 0.7 m, where a cube aside begins, at 2.8 m."""
    topic = "/bot/l/s/range"
    world = bot(sensor("sonar", SONAR)) + box("thing", place)
    heard, frames = hear(world, {topic: "sensor_msgs/Range"})

    told = heard[topic]
    assert told.range == pytest.approx(expected, abs=0.03)
    assert (told.min_range, told.max_range) == pytest.approx((0.1, 4.0))
    assert told.field_of_view == pytest.approx(2 * math.atan(0.25))
    assert told.header.frame_id == "bot/s"
    assert "bot/s" in frames


def test_a_magnetometer_feels_the_world_s_field_along_its_axes(hear: Any) -> None:
    topic = "/bot/l/s/magnetic_field"
    field = "<magnetic_field>1e-5 2e-5 -4e-5</magnetic_field>"
    own = sensor("magnetometer", pose=f"0 0 0 0 0 {math.pi / 2}")
    heard, frames = hear(field + bot(own), {topic: "sensor_msgs/MagneticField"})

    felt = heard[topic].magnetic_field
    assert (felt.x, felt.y, felt.z) == pytest.approx((2e-5, -1e-5, -4e-5), abs=1e-12)
    assert heard[topic].header.frame_id in frames


def test_an_altimeter_tells_height_above_its_start_and_how_it_grows(hear: Any) -> None:
    """Free fall for a twentieth of a second from 7 m."""
    topics = {
        "/bot/l/s/altitude": "geometry_msgs/Vector3Stamped",
        "/bot/l/s/vertical_velocity": "geometry_msgs/Vector3Stamped",
    }
    heard, _ = hear(bot(sensor("altimeter"), pose="0 0 7 0 0 0", static=0), topics)

    height, speed = (heard[topic].vector.z for topic in topics)
    assert height == pytest.approx(-0.5 * 9.8 * 0.05**2, rel=0.03)
    assert speed == pytest.approx(-9.8 * 0.05, rel=0.01)


def test_a_barometer_reads_the_standard_atmosphere(hear: Any) -> None:
    """ISA: 89874.6 Pa at 1000 m."""
    topic = "/bot/l/s/air_pressure"
    inside = (
        f"<air_pressure><reference_altitude>900</reference_altitude><pressure>{noise(0.0)}</pressure></air_pressure>"
    )
    heard, frames = hear(
        bot(sensor("air_pressure", inside), pose="0 0 100 0 0 0"), {topic: "sensor_msgs/FluidPressure"}
    )

    assert heard[topic].fluid_pressure == pytest.approx(89876.3, abs=0.5)
    assert heard[topic].header.frame_id in frames


def test_an_air_speed_sensor_feels_what_meets_it(hear: Any) -> None:
    """Still in a head wind of 10 m/s: ρ v² / 2 of air of 1.225 kg/m³."""
    topic = "/bot/l/s/air_speed"
    wind = "<wind><linear_velocity>-10 3 0</linear_velocity></wind>"
    heard, _ = hear(wind + bot(sensor("air_speed")), {topic: "sensor_msgs/FluidPressure"})

    assert heard[topic].fluid_pressure == pytest.approx(0.5 * 1.225 * 100, rel=1e-3)


@pytest.mark.parametrize(("pitch", "sees"), [(0.0, True), (-0.4, True), (-math.pi / 2, False)])
def test_a_logical_camera_lists_the_ground_unless_it_looks_straight_up(hear: Any, pitch: float, sees: bool) -> None:
    own = "<logical_camera><near>0.5</near><far>6</far><horizontal_fov>1</horizontal_fov></logical_camera>"
    eye = sensor("logical_camera", own, pose=f"0 0 1 0 {pitch} 0")
    plane = "<geometry><plane><normal>0 0 1</normal></plane></geometry>"
    link = f'<link name="l"><collision name="c">{plane}</collision></link>'
    topic = "/bot/l/s/models"
    heard, _ = hear(bot(eye) + f'<model name="ground"><static>1</static>{link}</model>', {topic: "tf2_msgs/TFMessage"})

    assert [t.child_frame_id for t in heard[topic].transforms] == ["ground"] * sees


def test_a_logical_camera_tells_models_in_its_pyramid_where_they_are(hear: Any) -> None:
    """Models: one ahead, one partly inside, one outside, one too far; the sensor's own model is never seen."""
    own = "<logical_camera><near>0.5</near><far>6</far><horizontal_fov>1</horizontal_fov></logical_camera>"
    eye = sensor("logical_camera", own, pose=f"0 0 1 0 0 {math.pi / 2}")
    things = box("ahead", "0 3 1.2") + box("rim", "2 3 1") + box("aside", "3 3 1") + box("far", "0 9 1")
    topic = "/bot/l/s/models"
    heard, frames = hear(bot(eye) + things, {topic: "tf2_msgs/TFMessage"})

    seen = {t.child_frame_id: t.transform for t in heard[topic].transforms}
    assert set(seen) == {"ahead", "rim"}
    place = seen["ahead"].translation
    assert (place.x, place.y, place.z) == pytest.approx((3, 0, 0.2), abs=1e-9)
    assert seen["ahead"].rotation.z == pytest.approx(-math.sqrt(0.5))
    assert {t.header.frame_id for t in heard[topic].transforms} == {"bot/s"} <= frames


RADIO = "<transceiver><essid>{}</essid><frequency>2442</frequency><gain>3</gain><power>{}</power></transceiver>"


def levels(message: Any) -> dict[str, float]:
    return {status.name: float(status.values[1].value) for status in message.status}


@pytest.mark.parametrize("wall", [False, True])
def test_a_receiver_hears_transmitters_by_gazebo_s_model(hear: Any, wall: bool) -> None:
    """Power and gains, less free space at 1 m, less 60 dB a decade (120 behind a wall) and a random loss."""
    sent = sensor("wireless_transmitter", RADIO.format("near", 40))
    own = sensor("wireless_receiver", "<transceiver><gain>2</gain><sensitivity>-200</sensitivity></transceiver>")
    deaf = sensor("wireless_transmitter", RADIO.format("other", 40).replace("2442", "5000"))
    world = bot(own) + bot(sent, name="tx", pose="10 0 0 0 0 0") + bot(deaf, name="tx5", pose="3 0 0 0 0 0")
    topic = "/bot/l/s/nodes"
    barrier = box("wall", "5 0 0") if wall else ""
    heard, frames = hear(world + barrier, {topic: "diagnostic_msgs/DiagnosticArray"})

    (level,) = levels(heard[topic]).values()
    assert levels(heard[topic]).keys() == {"near"}
    free = 20 * math.log10(299_792_458 / 2442e6 / (4 * math.pi))
    most = 40 + 3 + 2 + free - (120 if wall else 60)
    assert most - 30 <= level <= most  # five deviations of the random loss
    assert heard[topic].header.frame_id in frames


def test_a_receiver_does_not_hear_what_is_too_weak(described: Any) -> None:
    own = sensor("wireless_receiver", "<transceiver><sensitivity>0</sensitivity></transceiver>")
    sent = bot(sensor("wireless_transmitter"), name="tx", pose="30 0 0 0 0 0")
    sim = described(bot(own) + sent)
    (receiver,) = mount_sensors(sim)

    assert receiver.measure(sim.snapshot()).signals == ()


def test_an_rfid_sensor_tells_the_tags_within_five_metres(hear: Any) -> None:
    tags = "".join(bot(sensor("rfidtag", name="t"), name=f"tag{x}", pose=f"{x} 0 0 0 0 0") for x in (1, 4, 6))
    topic = "/bot/l/s/tags"
    heard, _ = hear(bot(sensor("rfid")) + tags, {topic: "diagnostic_msgs/DiagnosticArray"})

    assert [status.name for status in heard[topic].status] == ["tag1::l::t", "tag4::l::t"]


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
def test_an_imu_tells_its_orientation_in_the_frame_that_it_names(hear: Any, reference: str, expected) -> None:
    """The world's x axis is 30 degrees north of east, the imu's 0.3 rad further."""
    if reference:
        reference = f"<orientation_reference_frame>{reference}</orientation_reference_frame>"
    place = "<spherical_coordinates><heading_deg>30</heading_deg></spherical_coordinates>"
    topic = "/bot/l/s/imu"
    own = sensor("imu", f"<imu>{reference}</imu>")
    heard, _ = hear(place + bot(own, pose="0 0 0 0 0 0.3"), {topic: "sensor_msgs/Imu"})

    turn = heard[topic].orientation
    w, x, y, z = quaternion_from_rpy(*expected)
    same = abs(turn.w * w + turn.x * x + turn.y * y + turn.z * z)
    assert same == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("rows", [1, 3])
def test_rays_tell_how_bright_what_they_meet_is(hear: Any, rows: int) -> None:
    scan = "<scan><horizontal><samples>3</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle></horizontal>"
    scan += f"<vertical><samples>{rows}</samples><min_angle>0</min_angle><max_angle>0</max_angle></vertical></scan>"
    own = sensor("ray", f"<ray>{scan}<range><min>0.1</min><max>9</max></range></ray>")
    world = bot(own) + box("bright", "4 0 0", retro=250) + box("dull", "4 2.2 0")
    topic, type_ = ("/bot/l/s/scan", "LaserScan") if rows == 1 else ("/bot/l/s/points", "PointCloud2")
    heard, _ = hear(world, {topic: f"sensor_msgs/{type_}"})

    told = heard[topic]
    if rows == 1:
        assert list(told.intensities) == [0, 250, 0]
        assert np.isfinite(told.ranges[1:]).all()
    else:
        points = np.frombuffer(told.data.tobytes(), dtype="<f4").reshape(-1, told.point_step // 4)
        assert [field.name for field in told.fields] == ["x", "y", "z", "intensity"]
        assert sorted(points[:, 3].tolist()) == [0, 0, 0, 250, 250, 250]


def test_a_force_torque_sensor_has_noise_on_each_axis(described: Any) -> None:
    settings = f"<force><x>{noise(2.0)}</x></force><torque><z>{noise(0.5)}</z></torque>"
    own = f'<sensor name="f" type="force_torque"><force_torque>{settings}</force_torque></sensor>'
    joint = f'<joint name="j" type="fixed"><parent>world</parent><child>l</child>{own}</joint>'
    sim = described(f'<model name="bot"><link name="l">{MASS}</link>{joint}</model>')
    (felt,) = mount_sensors(sim)
    sim.run(0.01)

    wrenches = [felt.measure(sim.snapshot()).wrench for _ in range(400)]
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
        ("ray", f"<ray>{PINK}{FAR}", "no noise type 'pink': gaussian, gaussian_quantized, none; none is used"),
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
def test_settings_that_cannot_be_are_mended_aloud(described: Any, type_: str, inside: str, sentence: str) -> None:
    sim = described(bot(sensor(type_, inside)))
    (mounted,) = mount_sensors(sim)

    assert mounted.measure(sim.snapshot()).time_ns == 0
    (warning,) = sim.report.warnings
    assert "w.sdf:1: warning: " in warning
    assert sentence in warning


def test_a_force_torque_sensor_on_a_link_says_that_it_tells_nothing(described: Any) -> None:
    sim = described(bot(sensor("force_torque")))

    assert mount_sensors(sim) == []
    (warning,) = sim.report.warnings
    assert warning.endswith("sensor 's': force_torque sensors measure joints; not simulated on a link")


def test_a_force_torque_sensor_names_the_direction_that_it_does_not_know(described: Any) -> None:
    settings = "<force_torque><measure_direction>up</measure_direction></force_torque>"
    joint = f"<parent>world</parent><child>l</child>{sensor('force_torque', settings)}"
    sim = described(f'<model name="m"><link name="l"/><joint name="j" type="fixed">{joint}</joint></model>')

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
        ),  # so high that it matters for the earth's radius
    ],
)
def test_air_that_cannot_be_crushes_nothing(described: Any, air: str, height: str, expected: float) -> None:
    own = sensor("air_pressure", f"<air_pressure><reference_altitude>{height}</reference_altitude></air_pressure>")
    sim = described(f"<atmosphere>{air}</atmosphere>" + bot(own))
    (barometer,) = mount_sensors(sim)

    assert barometer.measure(sim.snapshot()).pressure == pytest.approx(expected)


def test_settings_are_written_as_they_were_read(described: Any) -> None:
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
    sim = described(bot("".join(inner)))
    was = sim.world.models[0].links[0].sensors
    report = Diagnostics()
    text = write_sdf(sim.world, is_world=True, uri_of=written_uri, report=report)
    again = text.partition("<world")[2].partition(">")[2].rpartition("</world>")[0]
    now = described(again).world.models[0].links[0].sensors

    assert [(s.instrument, s.imu) for s in now] == [(s.instrument, s.imu) for s in was]
    assert report.warnings == []


def test_a_sensor_s_speed_is_that_of_its_own_point(described: Any) -> None:
    """Half a metre from the axis of a link that turns at 2 rad/s: 1 m/s upwards."""
    sim = described("<gravity>0 0 0</gravity>" + bot(sensor("altimeter", pose="0.5 0 0 0 0 0"), static=0))
    sim["bot"].set_twist(Twist(angular=(0.0, -2.0, 0.0)))
    (mounted,) = mount_sensors(sim)

    assert mounted.measure(sim.snapshot()).velocity == pytest.approx(1.0)
