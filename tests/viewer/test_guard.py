"""The guard before the page, over real sockets: requests of a foreign page are refused, its own are served."""

import urllib.error
import urllib.request
from collections.abc import Callable
from importlib.metadata import version
from urllib.parse import urlsplit

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin, Subprotocol

from trundle.page_address import AllowedNames
from trundle.viewer import Viewer, ViewerScene, ViewerState

EVIL = "http://evil.example"


def _get(url: str, **fields: str) -> tuple[int, str, str | None]:
    """Status, body and cookie."""
    request = urllib.request.Request(url, headers={name.title(): value for name, value in fields.items()})
    try:
        with urllib.request.urlopen(request, timeout=30) as answer:
            return answer.status, answer.read(500).decode("latin-1"), answer.headers["Set-Cookie"]
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read().decode(), None


def _connect(viewer: Viewer, origin: str | None, **fields: str) -> ClientConnection:
    return connect(
        f"ws://{urlsplit(viewer.url).netloc}",
        origin=None if origin is None else Origin(origin),
        subprotocols=[Subprotocol(f"viser-v{version('viser')}")],
        additional_headers={name.title(): value for name, value in fields.items()},
    )


def test_a_foreign_page_neither_reads_the_scene_nor_presses_a_button(viewer: Viewer) -> None:
    here = viewer.url
    with _connect(viewer, here) as own:
        assert own.recv(timeout=30)
    for origin in (EVIL, "null", here.replace("127.0.0.1", "localhost"), f"{here}.evil.example"):
        with pytest.raises(InvalidStatus) as refused:
            _connect(viewer, origin).close()
        assert refused.value.response.status_code == 403
        assert b"does not answer pages of" in (refused.value.response.body or b"")


def test_a_name_that_leads_here_but_is_not_ours_is_refused(viewer: Viewer) -> None:
    status, body, _ = _get(viewer.url, host="evil.example:8080")
    assert (status, body) == (
        403,
        "refused: this page is not served as 'evil.example:8080'; open it at localhost, "
        "or start trundle with --allow-host NAME\n",
    )
    assert _get(viewer.url, host="localhost:9000")[0] == 200


def test_files_are_not_for_foreign_pages(viewer: Viewer) -> None:
    assert _get(viewer.url, origin=EVIL)[0] == 403
    assert _get(f"{viewer.url}/index.html")[0] == 200


def test_off_loopback_the_token_opens_and_the_cookie_keeps_open(
    car_scene: Callable[..., ViewerScene], car_state: Callable[..., ViewerState]
) -> None:
    allowed = AllowedNames(origins=("https://studio.example",))
    with Viewer.start(car_scene(), host="0.0.0.0", port=0, allowed=allowed, state=car_state()) as viewer:
        bare = f"http://{urlsplit(viewer.url).netloc}"
        assert _get(bare)[0] == 403
        for origin in (None, bare, "https://studio.example"):
            with pytest.raises(InvalidStatus):
                _connect(viewer, origin).close()

        status, _, cookie = _get(viewer.url)

        assert status == 200
        assert cookie is not None
        kept = cookie.partition(";")[0]
        assert _get(bare, cookie=kept)[0] == 200
        with _connect(viewer, bare, cookie=kept) as own:
            assert own.recv(timeout=30)
        with pytest.raises(InvalidStatus):
            _connect(viewer, EVIL, cookie=kept).close()


def test_an_origin_that_is_allowed_is_served(
    car_scene: Callable[..., ViewerScene], car_state: Callable[..., ViewerState]
) -> None:
    allowed = AllowedNames(origins=("https://studio.example",))
    with Viewer.start(car_scene(), port=0, allowed=allowed, state=car_state()) as viewer:
        with _connect(viewer, "https://studio.example") as theirs:
            assert theirs.recv(timeout=30)
        with pytest.raises(InvalidStatus):
            _connect(viewer, EVIL).close()
