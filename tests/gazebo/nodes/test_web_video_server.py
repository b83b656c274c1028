"""web_video_server, requested as by a browser."""

import http.client
import io
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest
from PIL import Image
from tests.gazebo.nodes.bridge_client import port_of

from trundle.gazebo.nodes.web_video_server.pictures import Encoding, PictureError, encode_picture
from trundle.ros import Messages

RED = {"header": {"stamp": 1_500_000_000}, "width": 4, "height": 2, "encoding": "rgb8", "step": 12}
IMAGE = "sensor_msgs/Image"


@pytest.fixture
def port(graph) -> int:
    graph.client.advertise("/eye/image_raw", IMAGE, latch=True).publish({**RED, "data": bytes([255, 0, 0] * 8)})
    graph.client.advertise("/eye/camera_info", "sensor_msgs/CameraInfo", latch=True)
    graph.client.advertise("/compressed_only", IMAGE)
    graph.client.advertise("/compressed_only/compressed", "sensor_msgs/CompressedImage", latch=True).publish(
        {"format": "jpeg", "data": b"as it is"}
    )
    graph.client.advertise("/odd", IMAGE, latch=True).publish({**RED, "encoding": "yuv422", "data": bytes(24)})
    graph.loop.run(graph.client.wait_registered())
    graph.start("web_video_server/web_video_server", port=0)
    return port_of(graph, "web_video_server")


@contextmanager
def _opened(port: int, path: str, **fields: str) -> Iterator[http.client.HTTPResponse]:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60.0)
    connection.request("GET", path, headers=fields)
    with connection.getresponse() as response:
        yield response
    connection.close()


def _get(port: int, path: str, **fields: str) -> tuple[http.client.HTTPResponse, bytes]:
    with _opened(port, path, **fields) as response:
        return response, response.read()


def _part(response: http.client.HTTPResponse) -> tuple[dict[str, str], bytes]:
    """Read a part of a stream."""
    fields: dict[str, str] = {}
    while line := response.readline().strip():
        if not line.startswith(b"--"):
            name, _, value = line.decode().partition(": ")
            fields[name] = value
    data = response.read(int(fields["Content-Length"]))
    assert response.read(len(b"\r\n--boundarydonotcross\r\n")) == b"\r\n--boundarydonotcross\r\n"
    return fields, data


def test_the_index_lists_image_topics(port: int) -> None:
    text = _get(port, "/")[1].decode()

    assert '<li>/eye/<ul><li><a href="/stream_viewer?topic=/eye/image_raw">image_raw</a>' in text
    assert '<a href="/snapshot?topic=/compressed_only">' in text
    assert "camera_info<" not in text


@pytest.mark.parametrize(
    ("query", "content_type", "size"),
    [("", "image/jpeg", (4, 2)), ("&type=png", "image/png", (4, 2)), ("&width=8&quality=50", "image/jpeg", (8, 2))],
)
def test_images_are_streamed(port: int, query: str, content_type: str, size: tuple[int, int]) -> None:
    with _opened(port, f"/stream?topic=/eye/image_raw{query}") as response:
        assert response.getheader("Content-Type") == "multipart/x-mixed-replace;boundary=boundarydonotcross"
        fields, data = _part(response)

    image = Image.open(io.BytesIO(data)).convert("RGB")
    assert (fields["Content-type"], fields["X-Timestamp"], image.size) == (content_type, "1.500000", size)
    assert np.allclose(np.asarray(image)[1, 1], (255, 0, 0), atol=3)


def test_compressed_images_are_passed_on(port: int) -> None:
    with _opened(port, "/stream?topic=/compressed_only&type=ros_compressed") as response:
        assert _part(response)[1] == b"as it is"


def test_a_snapshot_is_one_picture(port: int) -> None:
    response, data = _get(port, "/snapshot?topic=eye/image_raw&height=6")

    assert Image.open(io.BytesIO(data)).size == (4, 6)
    assert response.getheader("Content-Type") == "image/jpeg"


def test_the_viewer_escapes_its_query(port: int) -> None:
    text = _get(port, "/stream_viewer?topic=%3Cscript%3E&type=%22%3E")[1].decode()

    assert "<script>" not in text
    assert 'src="/stream?topic=%3Cscript%3E&amp;type=%22%3E"' in text


@pytest.mark.parametrize(
    ("path", "status", "text"),
    [
        ("/stream?topic=/none", 404, "image topics: /compressed_only, /eye/image_raw, /odd"),
        ("/stream?topic=/eye/camera_info", 415, "sensor_msgs/CameraInfo"),
        ("/stream?topic=/eye/image_raw&type=vp8", 404, "mjpeg, png, ros_compressed"),
        ("/stream?topic=/eye/image_raw&width=x", 400, "width"),
        ("/snapshot?topic=/odd", 415, "yuv422"),
        ("/snapshot?topic=%00%FF", 404, "no topic"),
        ("/nothing", 404, "no such page"),
    ],
)
def test_invalid_requests_are_reported(port: int, path: str, status: int, text: str) -> None:
    response, data = _get(port, path)

    assert response.status == status
    assert text in data.decode()


def test_pages_of_other_origins_are_refused(port: int) -> None:
    assert _get(port, "/snapshot?topic=/eye/image_raw", Origin="http://evil.example")[0].status == 403
    local, _ = _get(port, "/snapshot?topic=/eye/image_raw", Origin="http://localhost:8000")
    image, _ = _get(port, "/snapshot?topic=/eye/image_raw")

    assert local.getheader("Access-Control-Allow-Origin") == "http://localhost:8000"
    assert image.getheader("Access-Control-Allow-Origin") is None
    assert image.getheader("Cross-Origin-Resource-Policy") == "same-site"


def test_a_closed_stream_unsubscribes(graph, port: int) -> None:
    source = graph.client.advertise("/compressed_only", IMAGE)
    with _opened(port, "/stream?topic=/compressed_only") as response:
        graph.until(lambda: source.has_subscribers)
        assert response.status == 200
    graph.until(lambda: not source.has_subscribers)


def test_depths_are_scaled(messages: Messages) -> None:
    depths = np.array([[1.0, 2.0], [np.nan, 4.0]], "<f4")
    message = messages.new(IMAGE, {"width": 2, "height": 2, "encoding": "32FC1", "step": 8, "data": depths.tobytes()})

    pixels = np.asarray(Image.open(io.BytesIO(encode_picture(message, Encoding(format="png")))))
    assert pixels.tolist() == [[63, 127], [0, 255]]


@pytest.mark.parametrize(
    "wrong", [{"width": 0}, {"height": 10**6}, {"step": 1}, {"encoding": "bayer_rggb8"}, {"data": b""}]
)
def test_invalid_images_are_rejected(messages: Messages, wrong: dict[str, object]) -> None:
    with pytest.raises(PictureError):
        encode_picture(messages.new(IMAGE, {**RED, "data": bytes(24), **wrong}), Encoding())
