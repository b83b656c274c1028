"""HTTP of the page: its session, the client's files, policies and refusals."""

import gzip
import http.client
import json
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, suppress
from email.message import Message
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from tests.manifests import empty_manifest
from tests.page.built_client import needs_client
from tests.page_client import PATIENCE_S, ProtocolClient, page_url
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Origin

import trundle
from trundle.base.http.access import Access, PageRequest
from trundle.base.http.page_address import AllowedNames, PageAddress
from trundle.page import PageServer, Session
from trundle.page.http.client_files import CLIENT, ClientFiles
from trundle.page.http.client_slots import MAX_CONTROLLING
from trundle.page.http.content_policy import response_fields
from trundle.page.world.draft_info import FileUrl

EVIL = "http://evil.example"


def _get(url: str, **fields: str) -> tuple[int, str, Message]:
    request = urllib.request.Request(url, headers={name.title(): value for name, value in fields.items()})
    try:
        with urllib.request.urlopen(request, timeout=30) as answer:
            return answer.status, answer.read().decode(), answer.headers
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read().decode(), error.headers


def test_session_json_holds_the_session(page: PageServer) -> None:
    session = json.loads(_get(page_url(page.url, "/session.json"))[1])

    assert session == {
        "title": "test", "kind": "simulation", "version": trundle.__version__, "robot": "cart", "rviz": None,
        "fixed_frame": None, "panels": [], "plots": [], "images": [], "drive_topic": None, "sliders": [],
        "joystick": False, "foxglove": page.foxglove_url, "node": None, "namespace": "/", "remappings": {},
        "terminals": [], "lesson": None, "view_only": False, "token": page.url.partition("?token=")[2],
        "view_token": page.view_url.partition("?token=")[2],
        "network_urls": [],
    }  # fmt: skip
    page.set_session(Session(title="other", kind="graph"))
    with ProtocolClient(page.url) as client:
        client.until(lambda: json.loads(_get(page_url(page.url, "/session.json"))[1])["title"] == "other")


def _bare(page: PageServer) -> str:
    """Return a page's URL without its token."""
    return page.url.partition("/?")[0]


def test_a_token_grants_access_from_any_origin(page: PageServer) -> None:
    """Foxglove's pages, on the web and on the desktop, have other origins."""
    here = _bare(page)
    for origin in (EVIL, "null", here.replace("127.0.0.1", "localhost"), f"{here}.evil.example", here):
        assert _get(f"{here}/session.json", origin=origin)[0] == 403
        with pytest.raises(InvalidStatus) as refused:
            ProtocolClient(here, origin=Origin(origin))
        assert refused.value.response.status_code == 403
        assert b"asks for its token" in (refused.value.response.body or b"")
    for origin in (EVIL, "https://app.foxglove.dev", here):
        with ProtocolClient(page.url, origin=Origin(origin), protocol="foxglove.sdk.v1") as client:
            client.until(lambda client=client: client.jsons)


@pytest.mark.parametrize(
    ("path", "status"),
    [
        ("/", 200),
        ("/session.json", 200),
        ("/world/model.glb", 200),
        ("/world/none.glb", 404),
        ("/camera.png?width=1&height=1", 400),
        ("/model.png?model=", 400),
        ("/model.glb?model=", 400),
        ("/icon.svg", 200),
        ("/none.js", 404),
    ],
)
def test_no_address_answers_without_the_token(page: PageServer, path: str, status: int) -> None:
    manifest = empty_manifest(1, files=(FileUrl(id="m", url="world/model.glb"),))
    page.set_world(manifest, {"world/model.glb": b"glTF"})
    with ProtocolClient(page.url) as client:
        client.subscribe("trundle/world")
        client.until(lambda: client.payloads("trundle/world"))
    image = {"sec-fetch-mode": "no-cors"}
    foreign: list[dict[str, str]] = [{}, {"origin": _bare(page)}, {"origin": EVIL}, {"origin": "null"}]
    foreign += [{**image, "sec-fetch-site": site} for site in ("cross-site", "same-site")]

    for fields in foreign:
        assert _get(f"{_bare(page)}{path}", **fields)[0] == 403
        assert _get(page_url(page.url, path), **fields)[0] == status


def test_a_browser_without_a_token_gets_a_form_for_the_link(page: PageServer) -> None:
    status, body, fields = _get(_bare(page), accept="text/html,*/*")

    assert status == 403
    assert "trundle page link" in body
    assert page.url.partition("token=")[2] not in body
    assert "default-src 'none'" in fields["Content-Security-Policy"]
    assert fields["Referrer-Policy"] == "no-referrer"
    assert _get(f"{_bare(page)}/session.json", accept="text/html,*/*")[1].startswith("refused: this page asks for its")


def test_wrong_tokens_are_answered_with_a_delay(page: PageServer) -> None:
    """Concurrent guesses wait for each other, and too many are refused."""
    with ThreadPoolExecutor(80) as pool:
        guesses = [pool.submit(_get, f"{_bare(page)}/session.json?token={number}") for number in range(80)]
        assert _get(page_url(page.url, "/session.json"))[0] == 200
        assert not any(guess.done() and guess.result()[0] == 403 for guess in guesses)
        statuses = [guess.result()[0] for guess in guesses]
    assert set(statuses) <= {403, 429}
    assert _get(f"{_bare(page)}/session.json?token=guess")[0] == 403


def test_foreign_host_names_are_refused(page: PageServer) -> None:
    status, body, _ = _get(page.url, host="evil.example:8080")

    assert (status, body) == (
        403,
        "refused: this page is not served as 'evil.example:8080'; open it at localhost, "
        "or start trundle with --allow-host NAME\n",
    )
    assert _get(page.url, host="localhost:9000")[0] == 200


def test_own_images_and_links_from_other_pages_are_served(page: PageServer) -> None:
    requests: list[dict[str, str]] = [
        {"sec-fetch-mode": "no-cors", "sec-fetch-site": "same-origin"},
        {"sec-fetch-mode": "navigate", "sec-fetch-site": "cross-site"},
    ]
    for fields in requests:
        assert _get(page_url(page.url, "/session.json"), **fields)[0] == 200


@pytest.fixture
def open_page() -> Iterator[PageServer]:
    allowed = AllowedNames(origins=("https://studio.example",))
    at = PageAddress(host="0.0.0.0", port=0, allowed=allowed)
    with PageServer.start(Session(title="test", kind="graph"), at=at) as page:
        yield page


def test_the_token_sets_a_cookie_that_grants_access(open_page: PageServer) -> None:
    bare = f"http://{urlsplit(open_page.url).netloc}"
    assert _get(bare)[0] == 403
    for origin in (bare, "https://studio.example"):
        with pytest.raises(InvalidStatus):
            ProtocolClient(bare, origin=Origin(origin))

    status, _, fields = _get(open_page.url)

    assert status == 200
    cookie = str(fields["Set-Cookie"]).partition(";")[0]
    assert _get(bare, cookie=cookie)[0] == 200
    with ProtocolClient(bare, origin=Origin(bare), additional_headers={"Cookie": cookie}) as client:
        client.until(lambda: client.jsons)
    with pytest.raises(InvalidStatus):
        ProtocolClient(bare, origin=Origin(EVIL), additional_headers={"Cookie": cookie})


def test_unknown_subprotocols_are_refused(page: PageServer) -> None:
    with pytest.raises(InvalidStatus) as refused:
        ProtocolClient(page.url, protocol="chat")

    assert refused.value.response.status_code == 400
    assert b"trundle.v1" in (refused.value.response.body or b"")


def test_duplicate_header_fields_are_refused(page: PageServer) -> None:
    connection = http.client.HTTPConnection(urlsplit(page.url).netloc, timeout=30)
    connection.putrequest("GET", f"/?{urlsplit(page.url).query}", skip_host=True)
    for name, value in (("Host", "localhost"), ("Origin", EVIL), ("Origin", EVIL)):
        connection.putheader(name, value)
    connection.endheaders()

    assert connection.getresponse().status == 403
    connection.close()


@pytest.mark.parametrize(
    "path", ["/../wire.py", "/%2e%2e/wire.py", "/assets/../../wire.py", "/nothing.js", "//etc/passwd"]
)
def test_only_files_of_the_client_are_served(page: PageServer, path: str) -> None:
    connection = http.client.HTTPConnection(urlsplit(page.url).netloc, timeout=30)
    connection.request("GET", f"{path}?{urlsplit(page.url).query}")

    assert connection.getresponse().status == 404
    connection.close()


def test_the_documents_policy_has_no_eval_and_blobs_for_textures() -> None:
    access = Access(host="127.0.0.1", port=80)
    policy = _policy(response_fields(access, PageRequest(target="/", host="127.0.0.1:80"), path="/"))

    assert policy["script-src"] == ["'self'"]
    assert {"blob:", "'self'"} <= set(policy["img-src"])
    assert {"blob:", "'self'", "ws://127.0.0.1:80"} <= set(policy["connect-src"])
    assert policy["frame-ancestors"] == ["'self'"]


def test_workers_must_not_open_connections() -> None:
    access = Access(host="127.0.0.1", port=80)
    request = PageRequest(target="/assets/decoder.worker-1a2b.js", host="127.0.0.1:80")
    policy = _policy(response_fields(access, request, path=request.target))

    assert policy["connect-src"] == ["'none'"]
    assert policy["default-src"] == ["'none'"]


@pytest.mark.parametrize("name", ["drive_worker", "socket_worker"])
def test_workers_with_a_socket_connect_to_the_pages_server_alone(name: str) -> None:
    access = Access(host="127.0.0.1", port=80)
    request = PageRequest(target=f"/assets/{name}-1a2b.js", host="127.0.0.1:80")
    policy = _policy(response_fields(access, request, path=request.target))

    assert {source for source in policy["connect-src"] if ":" in source and not source.endswith(":")} == {
        "ws://127.0.0.1:80",
        "wss://127.0.0.1:80",
    }
    assert policy["default-src"] == ["'none'"]


@needs_client
@pytest.mark.parametrize("encoding", ["gzip, deflate", "identity"])
def test_scripts_are_sent_compressed_to_browsers_that_accept_it(page: PageServer, encoding: str) -> None:
    """Browsers may cache them for ever, as their names contain a hash of the content."""
    script = max((CLIENT / "assets").glob("*.js"), key=lambda file: file.stat().st_size)
    request = urllib.request.Request(
        page_url(page.url, f"/assets/{script.name}"), headers={"Accept-Encoding": encoding}
    )
    with urllib.request.urlopen(request, timeout=30) as answer:
        body, fields = answer.read(), answer.headers

    assert fields["Content-Type"] == "text/javascript"
    assert "immutable" in fields["Cache-Control"]
    assert fields["Content-Encoding"] == ("gzip" if "gzip" in encoding else None)
    if "gzip" in encoding:
        assert len(body) < script.stat().st_size / 3
        body = gzip.decompress(body)
    assert body == script.read_bytes()


def test_files_of_the_client_are_found_by_path(tmp_path: Path) -> None:
    (tmp_path / "assets").mkdir()
    for name in ("index.html", "assets/a.js", "assets/a.js.gz"):
        (tmp_path / name).write_text(name)
    files = ClientFiles(tmp_path)

    assert files.find("") == files.find("index.html") == tmp_path / "index.html"
    assert files.find("assets/a.js") == tmp_path / "assets/a.js"
    assert files.find("assets/../index.html") is None
    assert files.find("assets/a.js.gz") is None


def _policy(fields: dict[str, str]) -> dict[str, list[str]]:
    parts = fields["Content-Security-Policy"].split("; ")
    return {part.split()[0]: part.split()[1:] for part in parts}


def test_clients_beyond_the_limit_are_refused_until_one_leaves(page: PageServer) -> None:
    with ExitStack() as stack:
        clients = [stack.enter_context(ProtocolClient(page.url)) for _ in range(MAX_CONTROLLING)]
        with pytest.raises(InvalidStatus) as refused:
            ProtocolClient(page.url)
        assert refused.value.response.status_code == 503
        stack.enter_context(ProtocolClient(page.url, protocol="trundle.drive.v1"))  # of a page that is connected
        clients[0].socket.close()
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            with suppress(InvalidStatus):
                stack.enter_context(ProtocolClient(page.url))
                return
    pytest.fail("the server answers no client any more")


def test_view_only_clients_do_not_use_up_the_slots_of_others(page: PageServer) -> None:
    """The newest view-only client replaces the oldest."""
    with ExitStack() as stack:
        crowd = [stack.enter_context(ProtocolClient(page.view_url)) for _ in range(95)]
        owner = stack.enter_context(ProtocolClient(page.url))
        owner.until(lambda: owner.channels)
        crowd[-1].until(lambda: crowd[-1].channels)
        with pytest.raises(ConnectionClosed):
            crowd[0].settle(PATIENCE_S)
        assert _get(page_url(page.url, "/session.json"))[0] == 200


def test_pictures_for_view_only_clients_do_not_delay_others(page: PageServer) -> None:
    """View-only clients get no pictures of models, as they cannot insert them."""
    view, control = (page_url(url, "/camera.png?width=64&height=48") for url in (page.view_url, page.url))
    with ThreadPoolExecutor(8) as pool:
        looking = [pool.submit(_get, view) for _ in range(6)]
        requests = []
        end = time.monotonic() + PATIENCE_S
        while len(requests) < 2 and time.monotonic() < end:
            requests += page.requests()
        done = pool.submit(_get, control)
        while len(requests) < 3 and time.monotonic() < end:
            requests += page.requests()
        assert not any(answer.done() for answer in looking)
        page.respond(requests[2].id, "no renderer here")
        assert "no renderer here" in done.result()[1]
        answered = 0
        while answered < 6 and time.monotonic() < end:
            for request in requests[:2] if answered == 0 else page.requests():
                page.respond_picture(request.id, b"PNG")
                answered += 1
        assert [answer.result()[0] for answer in looking] == [200] * 6
    assert _get(page_url(page.view_url, "/model.png?model=cart"))[0] == 403
