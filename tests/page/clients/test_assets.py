"""Files that clients fetch: only those of packages and around the source."""

import json
import os
import struct
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.manifests import empty_manifest
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session
from trundle.page.world.manifest import ModelInfo


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("ws") / "robot"
    (folder / "meshes").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>robot</name></package>")
    (folder / ".env").write_text("PASSWORD=1")
    (folder / "meshes/box.stl").write_bytes(b"solid box")
    (folder / "meshes/large.stl").write_bytes(bytes(10_000_000))
    (folder / "robot.urdf").write_text("<robot name='r'/>")
    (folder.parent / "secret.txt").write_text("secret")
    (folder / "meshes/link.stl").symlink_to(folder.parent / "secret.txt")
    return folder


@pytest.fixture(scope="module")
def client(robot: Path) -> Iterator[ProtocolClient]:
    with (
        PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0), source=robot / "robot.urdf") as page,
        ProtocolClient(page.url, protocol="foxglove.websocket.v1") as client,
    ):
        yield client


def _fetch(client: ProtocolClient, uri: str) -> tuple[bytes, str]:
    """Return content and error."""
    client.binaries.clear()
    client.send("fetchAsset", uri=uri, requestId=17)
    client.until(lambda: client.binaries)
    opcode, request_id, status, length = struct.unpack_from("<BIBI", client.binaries[0])
    assert (opcode, request_id, bool(status)) == (4, 17, length > 0)
    return client.binaries[0][10 + length :], client.binaries[0][10 : 10 + length].decode()


def test_files_of_the_package_are_sent(client: ProtocolClient, robot: Path) -> None:
    for uri in ("package://robot/meshes/box.stl", f"file://{robot}/meshes/box.stl"):
        assert _fetch(client, uri) == (b"solid box", "")


@pytest.mark.parametrize(
    ("uri", "reason"),
    [
        ("file:///etc/passwd", "leads to /etc/passwd"),
        ("package://robot/../secret.txt", "leads to"),
        ("package://robot/meshes/link.stl", "leads to"),
        ("package://robot/meshes/none.stl", "no such file"),
        ("package://robot/meshes", "directory"),
        ("package://nobody/a.stl", "no package 'nobody'"),
        ("file:///dev/zero", "not a file"),
        ("http://example.com/a.stl", "use one of package://, model://, file://"),
        ("/etc/passwd", "use one of"),
        ("package://robot/\0", ""),
        ("package://robot/package.xml", "only meshes, textures and robots are sent"),
        ("package://robot/.env", "only meshes, textures and robots are sent"),
    ],
)
def test_other_files_are_refused_with_the_reason(client: ProtocolClient, uri: str, reason: str) -> None:
    content, error = _fetch(client, uri)

    assert content == b""
    assert reason in error
    assert error


def test_large_files_arrive_one_after_another(client: ProtocolClient) -> None:
    """Together they exceed the limit of a queue."""
    client.binaries.clear()
    for number in range(40):
        client.send("fetchAsset", uri="package://robot/meshes/large.stl", requestId=number)
    client.until(lambda: len(client.binaries) == 40)

    assert [struct.unpack_from("<BIB", data)[1:] for data in client.binaries] == [(n, 0) for n in range(40)]


def test_the_65th_pending_request_is_refused(client: ProtocolClient) -> None:
    client.binaries.clear()
    for number in range(100):
        client.send("fetchAsset", uri="package://robot/meshes/large.stl", requestId=number)
    client.until(lambda: len(client.binaries) == 100)

    errors = [data for data in client.binaries if data[5]]
    assert errors
    assert b"64 requests for files are pending" in errors[0]


@pytest.mark.skipif(sys.platform != "linux", reason="needs file names that are no UTF-8")
def test_files_in_a_folder_whose_name_is_not_utf_8_are_sent(tmp_path: Path) -> None:
    folder = Path(os.fsdecode(os.fsencode(tmp_path) + b"/w\xff"))
    folder.mkdir()
    (folder / "box.stl").write_bytes(b"solid box")
    with (
        PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0), source=folder / "a.sdf") as page,
        ProtocolClient(page.url) as client,
    ):
        model = ModelInfo(name="a", static=True, source=str(folder / "a.sdf"))
        page.set_world(empty_manifest(1, models=(model,)), {})
        client.subscribe("trundle/world")
        client.until(lambda: client.payloads("trundle/world"))
        assert json.loads(client.payloads("trundle/world")[0])["models"][0]["source"] == f"{tmp_path}/w?/a.sdf"
        content, error = _fetch(client, f"file://{tmp_path}/none.stl")
        assert (content, "no such file" in error) == (b"", True)
