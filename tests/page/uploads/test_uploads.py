"""Upload of models over HTTP: stored until the page ends, and refused to view-only clients."""

import http.client
import io
import uuid
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit
from zipfile import ZipFile

import pytest
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session

CONFIG = "<model><name>{}</name><sdf version='1.6'>model.sdf</sdf></model>"


def zipped(files: dict[str, str]) -> bytes:
    """Return a .zip of texts by name."""
    data = io.BytesIO()
    with ZipFile(data, "w") as packed:
        for name, text in files.items():
            packed.writestr(name, text)
    return data.getvalue()


CART = zipped({"cart/model.config": CONFIG.format("A cart"), "cart/model.sdf": "<sdf/>"})


def post(
    url: str, files: dict[str, bytes], *, to: str = "models", kind: str = "multipart/form-data", **fields: str
) -> tuple[int, str]:
    """Send a form as a browser does; return status and body."""
    boundary, parts = uuid.uuid4().hex, urlsplit(url)
    body = b"".join(
        f'--{boundary}\r\nContent-Disposition: form-data; name="{name}"; filename="f"\r\n'
        f"Content-Type: application/octet-stream\r\n\r\n".encode("utf-8", "surrogateescape")
        + content
        + b"\r\n"
        for name, content in files.items()
    )
    connection = http.client.HTTPConnection(parts.netloc, timeout=60)
    headers = {"Content-Type": f"{kind}; boundary={boundary}"} | {
        name.replace("_", "-").title(): text for name, text in fields.items()
    }
    connection.request("POST", f"/{to}?{parts.query}", body + f"--{boundary}--\r\n".encode(), headers)
    answer = connection.getresponse()
    status, text = answer.status, answer.read().decode().strip()
    connection.close()
    return status, text


def _uploads(page: PageServer) -> Path:
    """Return the folder of uploads, which the owner knows before the upload is answered."""
    with ProtocolClient(page.url) as client:
        client.send("trundle/request", id=1, request="models")
        client.until(page.requests)
    assert page.uploads is not None
    return page.uploads


def test_an_archive_becomes_a_model_and_replaces_an_earlier_upload(page: PageServer) -> None:
    assert post(page.url, {"cart.zip": CART}, origin=page.url.partition("/?")[0]) == (
        200,
        '{"models":["cart"]}',
    )
    folder = _uploads(page)
    assert sorted(file.name for file in (folder / "cart").iterdir()) == ["model.config", "model.sdf"]
    files = {"cart/model.config": CONFIG.encode(), "cart/model.sdf": b"<sdf></sdf>", "cart/meshes/w.stl": b"solid"}
    assert post(page.url, files) == (200, '{"models":["cart"]}')
    assert (folder / "cart/model.sdf").read_bytes() == b"<sdf></sdf>"
    assert (folder / "cart/meshes/w.stl").read_bytes() == b"solid"
    assert [file.name for file in folder.parent.parent.glob("trundle-upload-*")] == []


def test_uploaded_code_is_held(page: PageServer) -> None:
    """A held file is not loaded as a plugin until the user consents."""
    files = {
        "coded/model.sdf": b"<sdf/>",
        "coded/code.py": b"",
        "coded/scripts/more.PY": b"",
        "coded/build/libcode.so": b"",
    }
    assert post(page.url, files)[0] == 200
    folder = _uploads(page) / "coded"
    held = {"code.py.held", "more.PY.held", "libcode.so.held"}
    assert {file.name for file in folder.rglob("*.*")} == {"model.config", "model.sdf", *held}


def test_a_single_file_is_a_model(page: PageServer) -> None:
    assert post(page.url, {"my wagon.urdf": b"<robot/>"}) == (200, '{"models":["my wagon"]}')
    assert "my wagon.urdf" in (_uploads(page) / "my wagon" / "model.config").read_text()


@pytest.mark.parametrize(
    ("files", "reason"),
    [
        ({"cart.zip": zipped({"readme.txt": ""})}, "no model.config, .sdf or .urdf in it"),
        ({"cart.zip": b"PK"}, "the archive cannot be unpacked"),
        ({"cart.zip": zipped({"../model.sdf": ""})}, "is not a valid path"),
        ({"../cart.sdf": b""}, "is not a valid path"),
        ({"\udcff/model.config": b"", "\udcff/model.sdf": b""}, "is not a valid path"),
        ({"ground_plane/model.config": b"", "ground_plane/m.sdf": b""}, "is on the model path already"),
        ({".hidden": b""}, "no model.config"),
        ({}, "no file was sent"),
    ],
)
def test_a_refused_upload_has_a_reason_and_stores_nothing(
    page: PageServer, files: dict[str, bytes], reason: str
) -> None:
    post(page.url, {"cart.zip": CART})
    before = sorted(_uploads(page).parent.rglob("*"))
    status, body = post(page.url, files)
    assert (status, reason in body) == (400, True), body
    assert sorted(_uploads(page).parent.rglob("*")) == before


def test_a_body_that_is_not_a_form_is_refused(page: PageServer) -> None:
    assert post(page.url, {"cart.zip": CART}, kind="text/plain")[0] == 400
    for broken in ("multipart/form-data", "multipart/form-data; boundary=other"):
        connection = http.client.HTTPConnection(urlsplit(page.url).netloc, timeout=60)
        target = f"/models?{urlsplit(page.url).query}"
        connection.request("POST", target, b"nonsense\r\n" * 1000, {"Content-Type": broken})
        assert connection.getresponse().status == 400
        connection.close()
    assert post(page.url, {"cart.zip": CART}, content_encoding="gzip")[0] == 400


def test_uploads_need_a_token_with_full_access(page: PageServer) -> None:
    files = {"intruder.zip": zipped({"intruder/model.config": "", "intruder/model.sdf": ""})}
    assert post(page.view_url, files) == (403, "this link is view-only")
    bare = page.url.partition("?")[0]
    foreign: list[dict[str, str]] = [{}, {"origin": bare.rstrip("/")}, {"origin": "http://evil.example"}]
    for fields in (*foreign, {"origin": "null"}):
        assert post(bare, files, **fields)[0] == 403
    assert post(f"{bare}?view_only&{urlsplit(page.url).query}", files) == (403, "this link is view-only")
    assert post(page.url, files, host="evil.example")[0] == 403
    assert post(page.url, {"cart.zip": CART})[0] == 200
    assert not (_uploads(page) / "intruder").exists()


@pytest.fixture
def graph_page() -> Iterator[PageServer]:
    with PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0)) as page:
        yield page


def test_uploads_without_a_simulation_or_a_token_are_refused(graph_page: PageServer) -> None:
    assert post(graph_page.url, {"cart.zip": CART}) == (400, "models can only be inserted into a simulation")
    assert post(graph_page.url.partition("?")[0], {"cart.zip": CART})[0] == 403
    assert graph_page.uploads is None


def test_uploads_are_removed_when_the_page_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    with PageServer.start(Session(title="t", kind="simulation"), at=PageAddress(port=0)) as page:
        assert post(page.url, {"cart.zip": CART})[0] == 200
        assert list(tmp_path.glob("trundle-models-*/models/cart/model.sdf")) != []
    assert list(tmp_path.glob("trundle-models-*")) == []
