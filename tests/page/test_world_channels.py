"""The owner's data arrives at clients: world, poses, joints, lines, clock, pictures."""

import json
import struct
import urllib.error
import urllib.request

import numpy as np
import pytest
from tests.manifests import empty_manifest
from tests.page_client import ProtocolClient, page_url

from trundle.page import ClockState, Line, PageServer, Recording
from trundle.page.world.draft_info import FileUrl
from trundle.page.world.manifest import CameraInfo
from trundle.ros import Messages

ORIGIN = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
EYE = CameraInfo(
    name="eye",
    topic="/eye/image_raw",
    body=0,
    pose=ORIGIN,
    horizontal_fov=1.0,
    width=8,
    height=8,
    near=0.1,
    far=10.0,
    rate=30.0,
)


def _rows(count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(count, 7))


def _poses(payload: bytes) -> tuple[int, int, np.ndarray, np.ndarray]:
    """Return time, generation, bodies and poses, by the layout in docs/protocol.md."""
    time_ns, generation, count = struct.unpack_from("<QII", payload)
    bodies = np.frombuffer(payload, "<u4", count, 16)
    return time_ns, generation, bodies, np.frombuffer(payload, "<f4", 7 * count, 16 + 4 * count).reshape(count, 7)


def test_all_poses_are_sent_first_and_then_only_changed_ones(page: PageServer) -> None:
    rows = _rows(5)
    page.set_world(empty_manifest(1), {})
    page.put_poses(10, rows)
    with ProtocolClient(page.url) as client:
        client.subscribe("trundle/poses")
        client.until(lambda: len(client.payloads("trundle/poses")) == 1)
        moved = rows.copy()
        moved[[1, 3]] += 1.0
        page.put_poses(20, moved)
        client.until(lambda: len(client.payloads("trundle/poses")) == 2)

    first, second = map(_poses, client.payloads("trundle/poses"))
    assert (first[:2], second[:2]) == ((10, 1), (20, 1))
    assert (first[2].tolist(), second[2].tolist()) == ([0, 1, 2, 3, 4], [1, 3])
    np.testing.assert_allclose(first[3], rows[:, [0, 1, 2, 4, 5, 6, 3]], rtol=1e-6)
    np.testing.assert_allclose(second[3], moved[[1, 3]][:, [0, 1, 2, 4, 5, 6, 3]], rtol=1e-6)


def test_later_clients_get_the_state_of_a_paused_world(page: PageServer) -> None:
    page.set_world(empty_manifest(2), {})
    page.put_poses(30, _rows(2))
    for _ in range(2):
        with ProtocolClient(page.url) as client:
            client.subscribe("trundle/poses")
            client.until(lambda: [_poses(p)[2].tolist() for p in client.payloads("trundle/poses")[-1:]] == [[0, 1]])


def test_poses_wait_for_the_manifest_of_their_generation(page: PageServer) -> None:
    with ProtocolClient(page.url) as client:
        client.subscribe("trundle/world")
        client.subscribe("trundle/poses")
        for generation in range(3, 8):
            page.set_world(empty_manifest(generation), {})
            page.put_poses(generation, _rows(generation, generation))
        client.until(lambda: any(_poses(p)[1] == 7 for p in client.payloads("trundle/poses")))

    shown = 0
    for topic, _, payload in client.messages:
        if topic == "trundle/world":
            shown = json.loads(payload)["generation"]
        else:
            assert _poses(payload)[1] <= shown


def test_files_of_the_world_are_served_while_the_manifest_names_them(page: PageServer) -> None:
    files = (FileUrl(id="a", url="/world/a.glb"), FileUrl(id="b", url="/world/b.glb"))
    with ProtocolClient(page.url) as client:
        client.subscribe("trundle/world")
        page.set_world(empty_manifest(10, files=files), {"/world/a.glb": b"glTF a", "/world/b.glb": b"glTF b"})
        page.set_world(empty_manifest(11, files=files[1:]), {})
        client.until(lambda: any(json.loads(p)["generation"] == 11 for p in client.payloads("trundle/world")))

    with urllib.request.urlopen(page_url(page.url, "/world/b.glb")) as answer:
        assert (answer.read(), answer.headers["Content-Type"]) == (b"glTF b", "model/gltf-binary")
    with pytest.raises(urllib.error.HTTPError, match="404"):
        urllib.request.urlopen(page_url(page.url, "/world/a.glb"))


def test_resources_of_the_worlds_files_are_served_with_their_media_type(page: PageServer) -> None:
    kinds = {"/world/a.bin": "application/octet-stream", "/world/b.png": "image/png", "/world/c.jpg": "image/jpeg"}
    with ProtocolClient(page.url) as client:
        client.subscribe("trundle/world")
        page.set_world(empty_manifest(15, resources=tuple(kinds)), dict.fromkeys(kinds, b"content"))
        client.until(lambda: any(json.loads(p)["generation"] == 15 for p in client.payloads("trundle/world")))

    for url, kind in kinds.items():
        with urllib.request.urlopen(page_url(page.url, url)) as answer:
            assert (answer.read(), answer.headers["Content-Type"]) == (b"content", kind)
            assert "immutable" in answer.headers["Cache-Control"]


def test_a_camera_is_advertised_before_its_first_picture(page: PageServer) -> None:
    """A camera draws only while it is watched, and only advertised channels can be watched."""
    with ProtocolClient(page.url) as client:
        page.set_world(empty_manifest(16, cameras=(EYE,)), {})
        client.subscribe("/eye/image_raw")
        client.until(lambda: page.is_watched("/eye/image_raw"))


def test_joints_lines_and_the_clock_arrive(page: PageServer) -> None:
    page.set_world(empty_manifest(12), {})
    joints = np.arange(6.0).reshape(2, 3)
    points = np.arange(9.0, dtype=np.float32).reshape(3, 3)
    page.put_joints(40, joints)
    page.put_lines(41, [Line(id="ray é", rgba=(1, 2, 3, 255), points=points, kind="pairs")])
    page.put_ranges(41, [Line(id="points", rgba=(1, 2, 3, 255), points=points, kind="points")])
    page.put_contacts(41, np.arange(9.0).reshape(1, 9))
    page.put_state(ClockState(time_ns=42, paused=True, speed=None, recording=Recording(7)))
    with ProtocolClient(page.url) as client:
        for name in ("joints", "lines", "ranges", "contacts", "state"):
            client.subscribe(f"trundle/{name}")
            client.until(lambda name=name: client.payloads(f"trundle/{name}"))
        client.until(lambda: 42 in client.times)

    assert client.payloads("trundle/joints") == [struct.pack("<QII6d", 40, 12, 2, *range(6))]
    assert client.payloads("trundle/contacts") == [struct.pack("<QII9d", 41, 12, 1, *range(9))]
    assert client.payloads("trundle/ranges") == [
        struct.pack("<QII6s4BII9f", 41, 1, 6, b"points", 1, 2, 3, 255, 2, 3, *range(9))
    ]
    name = "ray é".encode()
    assert client.payloads("trundle/lines") == [
        struct.pack("<QII", 41, 1, len(name)) + name + struct.pack("<4BII9f", 1, 2, 3, 255, 1, 3, *range(9))
    ]
    assert json.loads(client.payloads("trundle/state")[-1]) == {
        "time_ns": 42, "paused": True, "real_time_factor": None, "speed": None, "recording": {"since_ns": 7},
    }  # fmt: skip


def test_a_growing_world_gets_a_larger_mailbox(page: PageServer) -> None:
    with ProtocolClient(page.url) as client:
        client.subscribe("trundle/poses")
        for generation, count in ((20, 10), (21, 1000), (22, 5000)):
            page.set_world(empty_manifest(generation), {})
            page.put_poses(generation, _rows(count))
            client.until(lambda g=generation: any(_poses(p)[1] == g for p in client.payloads("trundle/poses")))
        assert len(_poses(client.payloads("trundle/poses")[-1])[2]) == 5000


def test_a_camera_without_ros_is_a_topic_of_images(page: PageServer) -> None:
    pixels = np.arange(2 * 4 * 3, dtype=np.uint8).reshape(2, 4, 3)
    page.put_image("/cart/front/image_raw", 3_000_000_005, pixels)
    with ProtocolClient(page.url, protocol="foxglove.websocket.v1") as client:
        client.subscribe("/cart/front/image_raw")
        client.until(lambda: client.payloads("/cart/front/image_raw"))
        offer = client.channels["/cart/front/image_raw"]
        messages = Messages()
        image = messages.deserialize(client.payloads("/cart/front/image_raw")[0], "sensor_msgs/Image")

    assert (offer["encoding"], offer["schemaName"]) == ("ros1", "sensor_msgs/Image")
    offered = Messages(bare=True)
    offered.add_definition("sensor_msgs/Image", offer["schema"])
    assert offered.md5("sensor_msgs/Image") == messages.md5("sensor_msgs/Image")
    assert (image.height, image.width, image.encoding, image.step) == (2, 4, "rgb8", 12)
    assert (image.header.stamp.sec, image.header.stamp.nanosec, image.header.frame_id) == (3, 5, "cart_front")
    assert image.data.tobytes() == pixels.tobytes()


def test_the_owner_gets_the_watched_streams(page: PageServer) -> None:
    assert not page.is_watched("trundle/lines")
    with ProtocolClient(page.url) as client:
        number = client.subscribe("trundle/lines")
        client.until(lambda: page.is_watched("trundle/lines"))
        client.unsubscribe(number)
        client.until(lambda: not page.is_watched("trundle/lines"))
        client.subscribe("trundle/lines")
        client.until(lambda: page.is_watched("trundle/lines"))
    with ProtocolClient(page.url) as other:
        other.until(lambda: not page.is_watched("trundle/lines"))
