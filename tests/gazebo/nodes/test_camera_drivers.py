"""usb_cam, cv_camera and gscam with a video file in place of a camera."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

av: Any = pytest.importorskip("av", reason="av, which reads videos, is not installed: pip install av")

CALIBRATION = """
image_width: 64
image_height: 48
camera_name: narrow
camera_matrix: {rows: 3, cols: 3, data: [50, 0, 32, 0, 50, 24, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0.1, 0, 0, 0, 0]}
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
projection_matrix: {rows: 3, cols: 4, data: [50, 0, 32, 0, 0, 50, 24, 0, 0, 0, 1, 0]}
"""


@pytest.fixture(scope="module")
def video(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Five red pictures of 64x48 at 10 Hz."""
    file = tmp_path_factory.mktemp("video") / "red.mp4"
    with av.open(str(file), "w") as container:
        stream = container.add_stream("mpeg4", rate=10)
        stream.width, stream.height, stream.pix_fmt = 64, 48, "yuv420p"
        red = np.zeros((48, 64, 3), dtype=np.uint8)
        red[..., 0] = 200
        for _ in range(5):
            container.mux(stream.encode(av.VideoFrame.from_ndarray(red, format="rgb24")))
        container.mux(stream.encode())
    return file


@pytest.mark.parametrize(
    ("driver", "topic", "frame", "encoding", "red"),
    [
        ("usb_cam/usb_cam_node", "/usb_cam_node", "head_camera", "rgb8", 0),
        ("cv_camera/cv_camera_node", "/cv_camera_node", "camera", "bgr8", 2),
        ("gscam/gscam", "/camera", "camera_frame", "rgb8", 0),
    ],
)
def test_a_video_file_replaces_a_camera(
    graph, video: Path, tmp_path: Path, driver: str, topic: str, frame: str, encoding: str, red: int
) -> None:
    calibration = tmp_path / "narrow.yaml"
    calibration.write_text(CALIBRATION)
    images = graph.listen(f"{topic}/image_raw", "sensor_msgs/Image")
    infos = graph.listen(f"{topic}/camera_info", "sensor_msgs/CameraInfo")
    files: dict[str, Any] = {
        "usb_cam/usb_cam_node": {"video_device": str(video)},
        "cv_camera/cv_camera_node": {"file": str(video), "rate": 10.0},
        "gscam/gscam": {"gscam_config": f"filesrc location={video} ! decodebin ! videoconvert"},
    }
    graph.start(driver, camera_info_url=f"file://{calibration}", **files[driver])

    graph.until(lambda: images and infos)
    image, info = images[0], infos[0]
    assert (image.width, image.height, image.step, image.encoding) == (64, 48, 192, encoding)
    assert image.header.frame_id == info.header.frame_id == frame
    pixels = np.frombuffer(bytes(image.data), dtype=np.uint8).reshape(48, 64, 3)
    assert abs(int(pixels[20, 30, red]) - 200) < 12
    assert list(info.K) == [50, 0, 32, 0, 50, 24, 0, 0, 1]
    assert list(info.D) == [pytest.approx(0.1), 0, 0, 0, 0]


def test_usb_cam_repeats_a_file_and_cv_camera_ends_with_it(graph, video: Path) -> None:
    images = graph.listen("/usb_cam_node/image_raw", "sensor_msgs/Image")
    graph.start("usb_cam/usb_cam_node", video_device=str(video), framerate=100.0)
    graph.until(lambda: len(images) > 7)

    assert graph.start("cv_camera/cv_camera_node", file=str(video), rate=100.0).result(60.0) == 0


@pytest.mark.parametrize(
    ("driver", "params", "message"),
    [
        (
            "usb_cam/usb_cam_node",
            {"video_device": "/dev/video97"},
            "no camera /dev/video97; the path of a video file can replace it",
        ),
        ("gscam/gscam", {}, "neither gscam_config nor the variable GSCAM_CONFIG is set"),
        ("gscam/gscam", {"gscam_config": "rtspsrc location=rtsp://x ! decodebin"}, "is unknown; v4l2src device="),
        ("cv_camera/cv_camera_node", {"file": __file__}, "cannot open"),
    ],
)
def test_a_source_that_cannot_be_opened_is_reported(
    graph, capfd: pytest.CaptureFixture[str], driver: str, params: dict[str, Any], message: str
) -> None:
    assert graph.start(driver, **params).result(60.0) == 1

    assert message in capfd.readouterr().err
