"""Stand-ins for missing sensor description packages, as included by robots."""

import math
from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.description import load
from trundle.robots.model import Model, Sensor
from trundle.robots.packages import Packages

BODY = '<inertial><mass value="5"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
FIXED = '<joint name="fix" type="fixed"><parent link="base_link"/><child link="{}"/></joint>'
ORIGIN = '<origin xyz="0.1 0 0.3"/>'
HOKUYO = 'ros_topic="scan" update_rate="40" ray_count="1081" min_angle="-135" max_angle="135"'


def read(folder: Path, include: str, calls: str) -> tuple[Model, Diagnostics]:
    file = folder / "robot.urdf.xacro"
    file.write_text(
        f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n<xacro:include filename="$(find {include}"/>\n'
        f'<link name="base_link">{BODY}</link>{calls}</robot>'
    )
    report = Diagnostics()
    packages = Packages({"HOME": "/nobody"}, start=file)
    (model,) = load(str(file), report, packages=packages).world.models
    return model, report


def sensors(model: Model) -> list[Sensor]:
    return [sensor for link in model.links for sensor in link.sensors]


@pytest.mark.parametrize(
    ("include", "calls", "name", "plugin", "rays"),
    [
        (
            "lms1xx)/urdf/sick_lms1xx.urdf.xacro",
            f'<xacro:sick_lms1xx frame="front" topic="/scan" robot_namespace="/r"/>{FIXED.format("front")}',
            "front",
            "libgazebo_ros_laser.so",
            720,
        ),
        (
            "sick_tim)/urdf/sick_tim.urdf.xacro",
            f'<xacro:sick_tim551 name="laser" ros_topic="scan"/>{FIXED.format("laser_mount_link")}',
            "laser",
            "libgazebo_ros_laser.so",
            271,
        ),
        (
            "hector_sensors_description)/urdf/hokuyo_utm30lx.urdf.xacro",
            f'<xacro:hokuyo_utm30lx name="hokuyo" parent="base_link" {HOKUYO}>{ORIGIN}</xacro:hokuyo_utm30lx>',
            "hokuyo",
            "libgazebo_ros_gpu_laser.so",
            1081,
        ),
        (
            "velodyne_description)/urdf/VLP-16.urdf.xacro",
            f'<xacro:VLP-16 samples="440">{ORIGIN}</xacro:VLP-16>',
            "velodyne-VLP16",
            "libgazebo_ros_velodyne_laser.so",
            440,
        ),
        (
            "velodyne_description)/urdf/HDL-32E.urdf.xacro",
            f'<xacro:HDL-32E gpu="true" name="top">{ORIGIN}</xacro:HDL-32E>',
            "top-HDL32E",
            "libgazebo_ros_velodyne_gpu_laser.so",
            2187,
        ),
    ],
)
def test_a_scanner_s_macro_builds_its_sensor(
    tmp_path: Path, include: str, calls: str, name: str, plugin: str, rays: int
) -> None:
    model, report = read(tmp_path, include, calls)

    (sensor,) = sensors(model)
    assert (sensor.name, sensor.plugins[0].filename) == (name, plugin)
    assert sensor.scan is not None
    assert sensor.scan.horizontal.samples == rays
    (message,) = report.warnings
    assert f"robot.urdf.xacro:2: warning: no package {include.partition(')')[0]!r}: a stand-in of boxes" in message
    assert model.links[0].inertial.mass > 5.0


def test_a_vlp_16_has_its_lasers_on_its_base(tmp_path: Path) -> None:
    calls = f'<xacro:VLP-16 max_range="40" lasers="8">{ORIGIN}</xacro:VLP-16>'
    model, _ = read(tmp_path, "velodyne_description)/urdf/VLP-16.urdf.xacro", calls)

    (sensor,) = sensors(model)
    assert sensor.link_from_sensor.position == pytest.approx((0.1, 0.0, 0.3377))
    assert sensor.scan is not None
    assert (sensor.scan.vertical.samples, sensor.scan.vertical.max_angle) == (8, pytest.approx(math.radians(15)))
    assert (sensor.scan.min_m, sensor.scan.max_m) == (0.9, 40.0)


@pytest.mark.parametrize("kind", ["d415", "d435", "d435i"])
def test_a_realsense_has_its_frames_and_for_gazebo_its_cameras(tmp_path: Path, kind: str) -> None:
    include = f"realsense2_description)/urdf/_{kind}.urdf.xacro"
    call = f'<xacro:sensor_{kind} parent="base_link" name="front" use_nominal_extrinsics="true" {{}}>{ORIGIN}'
    plain, report = read(tmp_path, include, call.format("") + f"</xacro:sensor_{kind}>")
    assert sensors(plain) == []
    assert len(report.warnings) == 1

    model, report = read(tmp_path, include, call.format('topics_ns="eye"') + f"</xacro:sensor_{kind}>")
    assert [sensor.name for sensor in sensors(model)] == ["frontcolor", "frontired1", "frontired2", "frontdepth"]
    (plugin,) = model.plugins
    assert (plugin.name, plugin.filename) == ("eye", "librealsense_gazebo_plugin.so")
    assert plugin.node.string("colorOpticalframeName") == "front_color_optical_frame"
    assert len(report.warnings) == 1


GENERIC = 'ros_topic="image" cam_info_topic="info" update_rate="10" res_x="320" res_y="240" image_format="R8G8B8"'


@pytest.mark.parametrize(
    ("kind", "more", "name", "y", "size", "fov", "plugin", "message"),
    [
        (
            "generic_camera",
            f'{GENERIC} hfov="90" far_clip="30"',
            "eye_camera_sensor",
            0.0,
            (320, 240, 0.01, 30.0),
            90.0,
            "libgazebo_ros_camera.so",
            ["image", "info", "eye_optical_frame"],
        ),
        (
            "asus_camera",
            "",
            "eye",
            0.049,
            (640, 480, 0.5, 9.0),
            62.8,
            "libgazebo_ros_openni_kinect.so",
            ["eye/rgb/image_raw", "eye/rgb/camera_info", "eye_depth_optical_frame"],
        ),
    ],
)
def test_a_camera_s_macro_builds_its_sensor(
    tmp_path: Path,
    kind: str,
    more: str,
    name: str,
    y: float,
    size: tuple[float, ...],
    fov: float,
    plugin: str,
    message: list[str],
) -> None:
    include = f"hector_sensors_description)/urdf/{kind}.urdf.xacro"
    call = f'<xacro:{kind} name="eye" parent="base_link" {more}>{ORIGIN}</xacro:{kind}>'
    model, report = read(tmp_path, include, call)

    (sensor,) = sensors(model)
    (camera,) = sensor.cameras
    assert (sensor.name, sensor.plugins[0].filename) == (name, plugin)
    assert sensor.link_from_sensor.position == pytest.approx((0.1, y, 0.3))
    assert (camera.width_px, camera.height_px, camera.near_m, camera.far_m) == size
    assert math.degrees(camera.horizontal_fov_rad) == pytest.approx(fov)
    assert [
        sensor.plugins[0].node.string(tag) for tag in ("imageTopicName", "cameraInfoTopicName", "frameName")
    ] == message
    assert len(report.warnings) == 1


def test_a_file_missing_from_a_stand_in_is_named_with_the_package(tmp_path: Path) -> None:
    with pytest.raises(DescriptionError, match=r"no package 'velodyne_description'.*its stand-in has no VLS-128"):
        read(tmp_path, "velodyne_description)/urdf/VLS-128.urdf.xacro", "")


def test_an_installed_original_precedes_its_stand_in(tmp_path: Path) -> None:
    urdf = tmp_path / "src/lms1xx/urdf"
    urdf.mkdir(parents=True)
    (tmp_path / "src/lms1xx/package.xml").write_text("<package><name>lms1xx</name></package>")
    (urdf / "sick_lms1xx.urdf.xacro").write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="sick_lms1xx"><link name="original"/>'
        "</xacro:macro></robot>"
    )
    home = tmp_path / "src/robot"
    home.mkdir()
    (home / "package.xml").write_text("<package><name>robot</name></package>")
    calls = f"<xacro:sick_lms1xx/>{FIXED.format('original')}"
    model, report = read(home, "lms1xx)/urdf/sick_lms1xx.urdf.xacro", calls)

    assert sensors(model) == []
    assert report.warnings == []
