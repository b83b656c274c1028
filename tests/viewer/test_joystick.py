"""The joystick of the page: its order of axes and buttons, and which requests move it."""

import json
import urllib.error
import urllib.request
from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

import pytest

from trundle.access import Access
from trundle.viewer import MoveJoystick
from trundle.viewer.joystick import JoystickServer, joystick_of

REST = {"sticks": [0, 0, 0, 0], "buttons": [0] * 17}


class Served:
    """A server, and the requests that it accepted."""

    def __init__(self) -> None:
        self.moved: list[MoveJoystick] = []
        self.server = JoystickServer(Access(host="127.0.0.1", port=8080), self.moved.append)

    def post(self, body: bytes | dict[str, Any], *, path: str = "/move", query: str | None = None) -> int:
        at = urlsplit(self.server.url)
        data = body if isinstance(body, bytes) else json.dumps(body).encode()
        url = at._replace(path=path, query=at.query if query is None else query).geturl()
        try:
            with urllib.request.urlopen(urllib.request.Request(url, data), timeout=60) as r:
                return int(r.status)
        except urllib.error.HTTPError as error:
            error.close()
            return error.code


@pytest.fixture
def served() -> Iterator[Served]:
    serving = Served()
    yield serving
    serving.server.close()


def test_a_standard_pad_is_told_in_the_order_of_linux() -> None:
    buttons = [0.0] * 17
    buttons[0] = buttons[6] = buttons[9] = buttons[12] = 1.0  # A, left trigger, start, up
    assert joystick_of([-1.0, -0.5, 0.25, 0.0], buttons) == MoveJoystick(
        (1.0, 0.5, -1.0, -0.25, 0.0, 1.0, 0.0, 1.0), (1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0)
    )


def test_who_listens_everywhere_has_an_address_for_other_machines() -> None:
    served = JoystickServer(Access(host="0.0.0.0", port=8080), [].append)
    try:
        here, elsewhere = urlsplit(served.url), urlsplit(served.url_elsewhere or "")
        assert (here.hostname, here.port, here.query) == ("127.0.0.1", elsewhere.port, elsewhere.query)
        assert elsewhere.hostname not in (None, "", "0.0.0.0")
        for url in (served.url, served.url_elsewhere):
            with urllib.request.urlopen(str(url), timeout=60) as page:
                assert b"getGamepads" in page.read()
    finally:
        served.close()


def test_an_address_that_others_reach_needs_no_second_one(served: Served) -> None:
    assert served.server.url_elsewhere is None


def test_what_its_page_sends_is_taken(served: Served) -> None:
    assert served.post({**REST, "sticks": [0, -1, 0, 0]}) == 204
    assert [move.axes[1] for move in served.moved] == [1.0]


@pytest.mark.parametrize(
    ("body", "more", "code"),
    [
        (REST, {"query": ""}, 403),
        (REST, {"query": "token=guessed"}, 403),
        (REST, {"path": "/"}, 404),
        (b"{", {}, 400),
        ({**REST, "sticks": [0, 9, 0, 0]}, {}, 400),
        ({**REST, "sticks": [0, float("nan"), 0, 0]}, {}, 400),
        ({**REST, "buttons": [0]}, {}, 400),
        (b"[" * 3900, {}, 400),
        (b" " * 5000, {}, 413),
    ],
)
def test_anything_else_is_refused(served: Served, body: Any, more: dict[str, str], code: int) -> None:
    assert served.post(body, **more) == code
    assert served.moved == []


def test_its_page_opens_to_the_token_alone(served: Served) -> None:
    with urllib.request.urlopen(served.server.url, timeout=60) as answer:
        assert b"getGamepads" in answer.read()
    root = f"http://{urlsplit(served.server.url).netloc}/"
    with pytest.raises(urllib.error.HTTPError) as refused:
        urllib.request.urlopen(root, timeout=60)
    refused.value.close()
    assert refused.value.code == 403
