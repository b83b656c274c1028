"""Elements of <camera>, from the file to the messages."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import parse_xml
from trundle.gazebo.plugins.gazebo_ros.camera import read_border_crop
from trundle.robots.description import write_sdf, written_uri
from trundle.robots.model import Lens
from trundle.robots.parameters import TagParameters
from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import mount_cameras

from .test_cameras import IMAGE, INFO, WALL, F, camera_robot

IMAGE_TOPIC, INFO_TOPIC = "/bot/head/eye/image_raw", "/bot/head/eye/camera_info"


def test_a_fisheye_camera_renders_wide_angles_and_publishes_equidistant_coefficients(receive: Any) -> None:
    """Equidistant, 3 rad wide: an object 1.2 rad to the left is 1.2 / 1.5 of half the width from the center."""
    lens = "<lens><type>equidistant</type><scale_to_hfov>true</scale_to_hfov><cutoff_angle>1.57</cutoff_angle></lens>"
    image = "<image><width>200</width><height>200</height></image>"
    camera = f"<camera><horizontal_fov>3</horizontal_fov>{image}{lens}</camera>"
    ball = '<visual name="v"><geometry><sphere><radius>0.3</radius></sphere></geometry></visual>'
    pose = f"{4 * math.cos(1.2)} {4 * math.sin(1.2)} 0 0 0 0"
    sphere = f'<model name="ball"><static>1</static><pose>{pose}</pose><link name="l">{ball}</link></model>'
    received, _ = receive(
        camera_robot("wideanglecamera", cameras=camera) + sphere, {IMAGE_TOPIC: IMAGE, INFO_TOPIC: INFO}
    )

    pixels = received[IMAGE_TOPIC].data.reshape(200, 200, 3).astype(int)
    assert tuple(pixels[0, 0]) == (0, 0, 0)  # beyond the cutoff
    rows, columns = np.nonzero(np.abs(pixels - pixels[100, 100]).sum(axis=-1) * (pixels.sum(axis=-1) > 0))
    assert (columns.mean(), rows.mean()) == pytest.approx((99.5 - 100 * 1.2 / 1.5, 99.5), abs=1.5)
    info = received[INFO_TOPIC]
    assert info.distortion_model == "equidistant"
    assert info.K[0] == pytest.approx(100 / 1.5)
    assert list(info.D) == pytest.approx([0, 0, 0, 0], abs=1e-9)


def test_a_stereographic_lens_is_published_as_fitted_coefficients(receive: Any) -> None:
    camera = (
        "<camera><horizontal_fov>2.4</horizontal_fov><image><width>200</width><height>100</height></image></camera>"
    )
    received, _ = receive(camera_robot("wide_angle_camera", cameras=camera), {INFO_TOPIC: INFO})

    f, d = received[INFO_TOPIC].K[0], received[INFO_TOPIC].D
    for angle in (0.2, 0.7, 1.2):
        radius = f * (angle + sum(k * angle ** (2 * i + 3) for i, k in enumerate(d)))
        assert radius == pytest.approx(100 * math.tan(angle / 2) / math.tan(0.6), rel=1e-4)


def test_distortion_is_rendered_and_published(receive: Any) -> None:
    """A wall's left edge, at slope 1 / 3, appears where plumb_bob maps it, enlarged as in Gazebo."""
    distortion = "<distortion><k1>-0.3</k1><k2>0.1</k2><p1>0.01</p1><p2>-0.01</p2></distortion>"
    received, _ = receive(camera_robot("camera", inside=distortion) + WALL, {IMAGE_TOPIC: IMAGE, INFO_TOPIC: INFO})

    assert list(received[INFO_TOPIC].D) == [-0.3, 0.1, 0.01, -0.01, 0.0]
    x, r2 = -1 / 3, 1 / 9
    slope = x * (1 - 0.3 * r2 + 0.1 * r2**2) - 0.01 * 3 * r2
    corner = 32 / F  # of the image; the crop enlarges the diagonal from (-corner, -corner) to (corner, corner)
    slope /= 1 - 0.3 * 2 * corner**2 + 0.1 * 4 * corner**4
    row = received[IMAGE_TOPIC].data.reshape(48, 64, 3)[24, :, 0].astype(int)
    edge = int(np.flatnonzero(np.abs(np.diff(row)) > 20)[0])
    assert edge == pytest.approx(32 + F * slope - 1, abs=1)


@pytest.mark.parametrize(("border_crop", "is_whole"), [("", False), ("<borderCrop>0</borderCrop>", True)])
def test_a_plugin_may_disable_the_border_crop(load_world: Any, border_crop: str, is_whole: bool) -> None:
    sim = load_world(camera_robot("camera", inside="<distortion><k1>-0.3</k1></distortion>"))
    (camera,) = mount_cameras(sim, NativeRenderer)
    node = parse_xml(f"<plugin>{border_crop}</plugin>", name="a.sdf")

    read_border_crop(camera, TagParameters(node, sim.report))

    assert (np.abs(camera.projection.slopes()[0]).max() > 32 / F) == is_whole
    assert sim.report.warnings == []


def test_depths_through_a_distorting_lens_are_not_interpolated(receive: Any) -> None:
    topics = {"/bot/head/eye/depth/image_raw": IMAGE, "/bot/head/eye/points": "sensor_msgs/PointCloud2"}
    distortion = "<distortion><k1>-0.3</k1></distortion>"
    received, _ = receive(camera_robot("depth", inside=distortion) + WALL, topics)

    depths, cloud = (np.frombuffer(m.data.tobytes(), dtype="<f4") for m in received.values())
    assert depths[np.isfinite(depths)] == pytest.approx(3.0, abs=1e-5)
    points = cloud.reshape(-1, 4)[np.isfinite(depths)]
    assert np.abs(points[:, :2]).max(axis=0) == pytest.approx((1.0, 1.0), abs=0.06)  # the wall is 2 m by 2 m


def test_intrinsics_in_pixels_are_published_unchanged(receive: Any) -> None:
    lens = "<intrinsics><fx>70</fx><fy>60</fy><cx>30</cx><cy>20</cy><s>1</s></intrinsics>"
    projection = "<projection><p_fx>71</p_fx><p_fy>61</p_fy><p_cx>31</p_cx><p_cy>21</p_cy><tx>-7</tx></projection>"
    received, _ = receive(
        camera_robot("camera", inside=f"<lens>{lens}{projection}</lens>") + WALL, {IMAGE_TOPIC: IMAGE, INFO_TOPIC: INFO}
    )

    info = received[INFO_TOPIC]
    assert list(info.K) == [70, 1, 30, 0, 60, 20, 0, 0, 1]
    assert list(info.P) == [71, 0, 31, -7, 0, 61, 21, 0, 0, 0, 1, 0]
    row = received[IMAGE_TOPIC].data.reshape(48, 64, 3)[20, :, 0].astype(int)
    edges = np.flatnonzero(np.abs(np.diff(row)) > 20)
    assert (edges[0], edges[-1]) == pytest.approx((30 - 70 / 3 - 1, 30 + 70 / 3 - 1), abs=1.5)


@pytest.mark.parametrize(
    ("name", "encoding", "step"),
    [("L8", "mono8", 64), ("L16", "mono16", 128), ("B8G8R8", "bgr8", 192), ("BAYER_RGGB8", "bayer_rggb8", 64)],
)
def test_pixel_formats_are_published_with_ros_encodings(receive: Any, name: str, encoding: str, step: int) -> None:
    camera = f"<camera><image><width>64</width><height>48</height><format>{name}</format></image></camera>"
    received, _ = receive(camera_robot("camera", cameras=camera) + WALL, {IMAGE_TOPIC: IMAGE})

    image = received[IMAGE_TOPIC]
    assert (image.encoding, image.step, len(image.data)) == (encoding, step, 48 * step)


NOISE = "<noise><type>gaussian</type><mean>0.1</mean><stddev>0.05</stddev></noise>"


def test_noise_is_gaussian_and_grey(load_world: Any) -> None:
    images: list[Any] = []
    for inside in ("", NOISE):
        sim = load_world(camera_robot("camera", inside=inside))
        (camera,) = mount_cameras(sim, NativeRenderer)
        images.append(camera.measure(sim.snapshot()).rgb.astype(int))
    noise = images[1] - images[0]

    assert (noise == noise[..., :1]).all()
    assert noise.mean() / 255 == pytest.approx(0.1, abs=0.005)
    assert noise.std() / 255 == pytest.approx(0.05, abs=0.005)


def test_the_same_seed_makes_the_same_noise(load_world: Any) -> None:
    def rendered(seed: int) -> bytes:
        sim = load_world(camera_robot("camera", inside=NOISE), seed=seed)
        (camera,) = mount_cameras(sim, NativeRenderer)
        return b"".join(camera.measure(sim.snapshot()).rgb.tobytes() for _ in range(2))

    assert rendered(1) == rendered(1)
    assert rendered(1) != rendered(2)


BROKEN = [
    (
        "<image><width>0</width><height>0</height></image>",
        "a camera of 0 x 0 pixels is not possible; 320 x 240 is used",
    ),
    (
        "<image><width>100000</width><height>100000</height></image>",
        "a camera of 100000 x 100000 pixels is not possible; 320 x 240 is used",
    ),
    ("<horizontal_fov>0</horizontal_fov>", "horizontal_fov 0 rad is not possible; 1.047 is used"),
    ("<horizontal_fov>3.5</horizontal_fov>", "horizontal_fov 3.5 rad is not possible; 1.047 is used"),
    ("<horizontal_fov>nan</horizontal_fov>", "1.047 is used"),
    ("<clip><near>5</near><far>5</far></clip>", "clip near 5, far 5 shows nothing; 0.1 and 100 are used"),
    ("<horizontal_fov>1e-300</horizontal_fov>", "horizontal_fov 1e-300 rad is not possible; 1.047 is used"),
    ("<clip><near>1</near><far>1e300</far></clip>", "<far>: '1e300' is not within ±1e+18; "),
    ("<distortion><k1>1e17</k1></distortion>", "coefficients and a center beyond 1e+06 are not possible"),
    ("<lens><intrinsics><cx>1e9</cx></intrinsics></lens>", "cx 1e+09, cy 120, s 0 pixels show nothing"),
    ("<image><format>PINK</format></image>", "no image format PINK"),
    ("<pose>nan 0 0 0 0 0</pose>", "the identity is used"),
    ("<lens><intrinsics><fx>0</fx></intrinsics></lens>", "focal lengths of 0 and 277 pixels are not possible"),
    ("<box_type>4d</box_type>", "no box_type '4d': 2d,"),
]


@pytest.mark.parametrize(("inside", "sentence"), BROKEN)
def test_impossible_camera_settings_are_replaced_with_a_warning(load_world: Any, inside: str, sentence: str) -> None:
    sim = load_world(camera_robot("camera", cameras=f"<camera>{inside}</camera>"))
    (camera,) = mount_cameras(sim, NativeRenderer)

    image = camera.measure(sim.snapshot()).rgb
    assert image.shape == (240, 320, 3)
    assert any("w.sdf:1: warning: " in warning and sentence in warning for warning in sim.report.warnings)


@pytest.mark.parametrize(
    "inside",
    [
        "<lens><intrinsics><fx>0.1</fx><fy>1e6</fy><s>900</s></intrinsics></lens>",
        "<distortion><k1>-5</k1><k2>7</k2><center>9 9</center></distortion>",
    ],
)
def test_a_strange_lens_renders_no_view_larger_than_the_limit(load_world: Any, inside: str) -> None:
    sim = load_world(camera_robot("camera", cameras=f"<camera>{inside}</camera>"))
    (camera,) = mount_cameras(sim, NativeRenderer)
    ((_, face),) = camera.projection.pinhole_views

    assert camera.measure(sim.snapshot()).rgb.shape == (240, 320, 3)
    assert max(face.width_px, face.height_px) <= 16384


@pytest.mark.parametrize("inside", ["<c1>1e-9</c1>", "<c2>1e17</c2>", "<f>0</f>", "<c3>1e9</c3>", "<fun>cosh</fun>"])
def test_an_impossible_custom_lens_is_replaced_with_a_warning(load_world: Any, inside: str) -> None:
    lens = f"<lens><type>custom</type><custom_function>{inside}</custom_function></lens>"
    sim = load_world(camera_robot("wideanglecamera", cameras=f"<camera>{lens}</camera>"))
    (camera,) = mount_cameras(sim, NativeRenderer)

    assert camera.optics.lens == Lens(c1=1.0, c2=1.0, fun="tan")
    (warning,) = sim.report.warnings
    assert "a lens needs fun tan, sin or id, and c1, c2 and f neither 0 nor huge; tan is used alone" in warning


def test_an_impossible_lens_scale_is_ignored_with_a_warning(load_world: Any) -> None:
    fov = "<horizontal_fov>3.3</horizontal_fov><lens><type>gnomonical</type></lens>"
    sim = load_world(camera_robot("wideanglecamera", cameras=f"<camera>{fov}</camera>"))
    (camera,) = mount_cameras(sim, NativeRenderer)

    assert camera.measure(sim.snapshot()).rgb.shape == (240, 320, 3)
    (warning,) = sim.report.warnings
    assert warning.endswith("sensor 'eye': no scale of this lens spans 3.3 rad; <scale_to_hfov> is ignored")


def test_camera_settings_survive_writing_and_reading(load_world: Any) -> None:
    distortion = "<distortion><k1>-0.3</k1><p2>0.1</p2><center>0.4 0.6</center></distortion>"
    lens = "<lens><intrinsics><fx>70</fx><fy>60</fy><cx>30</cx><cy>20</cy><s>1</s></intrinsics></lens>"
    clip = "<depth_camera><clip><near>0.5</near><far>2.9</far></clip></depth_camera>"
    first = load_world(camera_robot("depth", inside=distortion + NOISE + lens + clip))
    wide = "<lens><type>equisolid_angle</type><cutoff_angle>1.2</cutoff_angle></lens><box_type>3d</box_type>"
    for sim in (first, load_world(camera_robot("wideanglecamera", inside=wide))):
        (original,) = sim.world.models[0].links[0].sensors
        report = Diagnostics()
        text = write_sdf(sim.world, is_world=True, uri_of=written_uri, report=report)
        (reread,) = (
            load_world(text.partition("<world")[2].partition(">")[2].rpartition("</world>")[0])
            .world.models[0]
            .links[0]
            .sensors
        )
        assert reread.cameras == original.cameras
        assert report.warnings == []
