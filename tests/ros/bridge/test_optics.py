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

from .test_cameras import IMAGE, INFO, WALL, F, eye

PICTURE, CALIBRATION = "/bot/head/eye/image_raw", "/bot/head/eye/camera_info"


def test_a_fisheye_sees_what_is_beside_it_and_tells_a_calibration_of_its_own(hear: Any) -> None:
    """Equidistant, 3 rad wide: what is 1.2 rad to the left is 1.2 / 1.5 of the half width from the middle."""
    lens = "<lens><type>equidistant</type><scale_to_hfov>true</scale_to_hfov><cutoff_angle>1.57</cutoff_angle></lens>"
    image = "<image><width>200</width><height>200</height></image>"
    camera = f"<camera><horizontal_fov>3</horizontal_fov>{image}{lens}</camera>"
    ball = '<visual name="v"><geometry><sphere><radius>0.3</radius></sphere></geometry></visual>'
    place = f"{4 * math.cos(1.2)} {4 * math.sin(1.2)} 0 0 0 0"
    thing = f'<model name="ball"><static>1</static><pose>{place}</pose><link name="l">{ball}</link></model>'
    heard, _ = hear(eye("wideanglecamera", cameras=camera) + thing, {PICTURE: IMAGE, CALIBRATION: INFO})

    pixels = heard[PICTURE].data.reshape(200, 200, 3).astype(int)
    assert tuple(pixels[0, 0]) == (0, 0, 0)  # beyond the cutoff
    rows, columns = np.nonzero(np.abs(pixels - pixels[100, 100]).sum(axis=-1) * (pixels.sum(axis=-1) > 0))
    assert (columns.mean(), rows.mean()) == pytest.approx((99.5 - 100 * 1.2 / 1.5, 99.5), abs=1.5)
    info = heard[CALIBRATION]
    assert info.distortion_model == "equidistant"
    assert info.K[0] == pytest.approx(100 / 1.5)
    assert list(info.D) == pytest.approx([0, 0, 0, 0], abs=1e-9)


def test_a_stereographic_lens_is_told_by_fitted_coefficients(hear: Any) -> None:
    camera = (
        "<camera><horizontal_fov>2.4</horizontal_fov><image><width>200</width><height>100</height></image></camera>"
    )
    heard, _ = hear(eye("wide_angle_camera", cameras=camera), {CALIBRATION: INFO})

    f, d = heard[CALIBRATION].K[0], heard[CALIBRATION].D
    for angle in (0.2, 0.7, 1.2):
        told = f * (angle + sum(k * angle ** (2 * i + 3) for i, k in enumerate(d)))
        assert told == pytest.approx(100 * math.tan(angle / 2) / math.tan(0.6), rel=1e-4)


def test_distortion_bends_the_picture_and_is_told(hear: Any) -> None:
    """A wall's left edge, at slope 1 / 3, is seen where plumb_bob puts it, enlarged as Gazebo does it."""
    bend = "<distortion><k1>-0.3</k1><k2>0.1</k2><p1>0.01</p1><p2>-0.01</p2></distortion>"
    heard, _ = hear(eye("camera", inside=bend) + WALL, {PICTURE: IMAGE, CALIBRATION: INFO})

    assert list(heard[CALIBRATION].D) == [-0.3, 0.1, 0.01, -0.01, 0.0]
    x, r2 = -1 / 3, 1 / 9
    seen = x * (1 - 0.3 * r2 + 0.1 * r2**2) - 0.01 * 3 * r2
    end = 32 / F  # of the image; the crop enlarges the diagonal from (-end, -end) to (end, end)
    seen /= 1 - 0.3 * 2 * end**2 + 0.1 * 4 * end**4
    row = heard[PICTURE].data.reshape(48, 64, 3)[24, :, 0].astype(int)
    edge = int(np.flatnonzero(np.abs(np.diff(row)) > 20)[0])
    assert edge == pytest.approx(32 + F * seen - 1, abs=1)


@pytest.mark.parametrize(("told", "is_whole"), [("", False), ("<borderCrop>0</borderCrop>", True)])
def test_a_plugin_may_leave_out_the_crop(described: Any, told: str, is_whole: bool) -> None:
    sim = described(eye("camera", inside="<distortion><k1>-0.3</k1></distortion>"))
    (camera,) = mount_cameras(sim, NativeRenderer)
    node = parse_xml(f"<plugin>{told}</plugin>", name="a.sdf")

    read_border_crop(camera, TagParameters(node, sim.report))

    assert (np.abs(camera.projection.slopes()[0]).max() > 32 / F) == is_whole
    assert sim.report.warnings == []


def test_depths_come_through_a_distorting_lens_unmixed(hear: Any) -> None:
    topics = {"/bot/head/eye/depth/image_raw": IMAGE, "/bot/head/eye/points": "sensor_msgs/PointCloud2"}
    bend = "<distortion><k1>-0.3</k1></distortion>"
    heard, _ = hear(eye("depth", inside=bend) + WALL, topics)

    depths, cloud = (np.frombuffer(m.data.tobytes(), dtype="<f4") for m in heard.values())
    assert depths[np.isfinite(depths)] == pytest.approx(3.0, abs=1e-5)
    points = cloud.reshape(-1, 4)[np.isfinite(depths)]
    assert np.abs(points[:, :2]).max(axis=0) == pytest.approx((1.0, 1.0), abs=0.06)  # the wall is 2 m by 2 m


def test_intrinsics_in_pixels_are_told_as_they_are(hear: Any) -> None:
    lens = "<intrinsics><fx>70</fx><fy>60</fy><cx>30</cx><cy>20</cy><s>1</s></intrinsics>"
    told = "<projection><p_fx>71</p_fx><p_fy>61</p_fy><p_cx>31</p_cx><p_cy>21</p_cy><tx>-7</tx></projection>"
    heard, _ = hear(eye("camera", inside=f"<lens>{lens}{told}</lens>") + WALL, {PICTURE: IMAGE, CALIBRATION: INFO})

    info = heard[CALIBRATION]
    assert list(info.K) == [70, 1, 30, 0, 60, 20, 0, 0, 1]
    assert list(info.P) == [71, 0, 31, -7, 0, 61, 21, 0, 0, 0, 1, 0]
    row = heard[PICTURE].data.reshape(48, 64, 3)[20, :, 0].astype(int)
    edges = np.flatnonzero(np.abs(np.diff(row)) > 20)
    assert (edges[0], edges[-1]) == pytest.approx((30 - 70 / 3 - 1, 30 + 70 / 3 - 1), abs=1.5)


@pytest.mark.parametrize(
    ("name", "encoding", "step"),
    [("L8", "mono8", 64), ("L16", "mono16", 128), ("B8G8R8", "bgr8", 192), ("BAYER_RGGB8", "bayer_rggb8", 64)],
)
def test_formats_are_heard_by_ros_names(hear: Any, name: str, encoding: str, step: int) -> None:
    camera = f"<camera><image><width>64</width><height>48</height><format>{name}</format></image></camera>"
    heard, _ = hear(eye("camera", cameras=camera) + WALL, {PICTURE: IMAGE})

    picture = heard[PICTURE]
    assert (picture.encoding, picture.step, len(picture.data)) == (encoding, step, 48 * step)


NOISE = "<noise><type>gaussian</type><mean>0.1</mean><stddev>0.05</stddev></noise>"


def test_noise_is_gaussian_and_grey(described: Any) -> None:
    pictures: list[Any] = []
    for inside in ("", NOISE):
        sim = described(eye("camera", inside=inside))
        (camera,) = mount_cameras(sim, NativeRenderer)
        pictures.append(camera.measure(sim.snapshot()).rgb.astype(int))
    grain = pictures[1] - pictures[0]

    assert (grain == grain[..., :1]).all()
    assert grain.mean() / 255 == pytest.approx(0.1, abs=0.005)
    assert grain.std() / 255 == pytest.approx(0.05, abs=0.005)


def test_the_same_seed_makes_the_same_noise(described: Any) -> None:
    def taken(seed: int) -> bytes:
        sim = described(eye("camera", inside=NOISE), seed=seed)
        (camera,) = mount_cameras(sim, NativeRenderer)
        return b"".join(camera.measure(sim.snapshot()).rgb.tobytes() for _ in range(2))

    assert taken(1) == taken(1)
    assert taken(1) != taken(2)


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
def test_a_camera_that_can_make_no_picture_is_mended_aloud(described: Any, inside: str, sentence: str) -> None:
    sim = described(eye("camera", cameras=f"<camera>{inside}</camera>"))
    (camera,) = mount_cameras(sim, NativeRenderer)

    picture = camera.measure(sim.snapshot()).rgb
    assert picture.shape == (240, 320, 3)
    assert any("w.sdf:1: warning: " in warning and sentence in warning for warning in sim.report.warnings)


@pytest.mark.parametrize(
    "inside",
    [
        "<lens><intrinsics><fx>0.1</fx><fy>1e6</fy><s>900</s></intrinsics></lens>",
        "<distortion><k1>-5</k1><k2>7</k2><center>9 9</center></distortion>",
    ],
)
def test_what_is_seen_through_a_strange_lens_is_no_larger_than_a_picture_may_be(described: Any, inside: str) -> None:
    sim = described(eye("camera", cameras=f"<camera>{inside}</camera>"))
    (camera,) = mount_cameras(sim, NativeRenderer)
    ((_, face),) = camera.projection.pinhole_views

    assert camera.measure(sim.snapshot()).rgb.shape == (240, 320, 3)
    assert max(face.width_px, face.height_px) <= 16384


@pytest.mark.parametrize("inside", ["<c1>1e-9</c1>", "<c2>1e17</c2>", "<f>0</f>", "<c3>1e9</c3>", "<fun>cosh</fun>"])
def test_a_custom_lens_that_cannot_be_is_mended_aloud(described: Any, inside: str) -> None:
    lens = f"<lens><type>custom</type><custom_function>{inside}</custom_function></lens>"
    sim = described(eye("wideanglecamera", cameras=f"<camera>{lens}</camera>"))
    (camera,) = mount_cameras(sim, NativeRenderer)

    assert camera.optics.lens == Lens(c1=1.0, c2=1.0, fun="tan")
    (warning,) = sim.report.warnings
    assert "a lens needs fun tan, sin or id, and c1, c2 and f neither 0 nor huge; tan is used alone" in warning


def test_a_lens_that_cannot_be_is_mended_aloud(described: Any) -> None:
    fov = "<horizontal_fov>3.3</horizontal_fov><lens><type>gnomonical</type></lens>"
    sim = described(eye("wideanglecamera", cameras=f"<camera>{fov}</camera>"))
    (camera,) = mount_cameras(sim, NativeRenderer)

    assert camera.measure(sim.snapshot()).rgb.shape == (240, 320, 3)
    (warning,) = sim.report.warnings
    assert warning.endswith("sensor 'eye': no scale of this lens spans 3.3 rad; <scale_to_hfov> is ignored")


def test_what_is_in_a_camera_is_written_as_it_was_read(described: Any) -> None:
    bend = "<distortion><k1>-0.3</k1><p2>0.1</p2><center>0.4 0.6</center></distortion>"
    lens = "<lens><intrinsics><fx>70</fx><fy>60</fy><cx>30</cx><cy>20</cy><s>1</s></intrinsics></lens>"
    clip = "<depth_camera><clip><near>0.5</near><far>2.9</far></clip></depth_camera>"
    first = described(eye("depth", inside=bend + NOISE + lens + clip))
    wide = "<lens><type>equisolid_angle</type><cutoff_angle>1.2</cutoff_angle></lens><box_type>3d</box_type>"
    for sim in (first, described(eye("wideanglecamera", inside=wide))):
        (was,) = sim.world.models[0].links[0].sensors
        report = Diagnostics()
        text = write_sdf(sim.world, is_world=True, uri_of=written_uri, report=report)
        (now,) = (
            described(text.partition("<world")[2].partition(">")[2].rpartition("</world>")[0])
            .world.models[0]
            .links[0]
            .sensors
        )
        assert now.cameras == was.cameras
        assert report.warnings == []
