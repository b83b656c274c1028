"""Requests that the page serves, as a table; tests/page/http/test_server.py uses real sockets."""

import socket

import pytest

from trundle.base.diagnostics import UsageError
from trundle.base.http.access import Access, PageRequest, without_tokens
from trundle.base.http.page_address import AllowedNames, is_loopback

HERE = "localhost:8080"
EVIL = "http://evil.example"
TOKEN = "abcdefgh"
CLOSED = {"host": "0.0.0.0"}
PAGE = {"needs_token": True}
KEPT = f"trundle-8080={TOKEN}"
PROXIED = {"allowed": AllowedNames(hosts=("robot.example",), origins=("https://studio.example",))}


def _access(**changes: object) -> Access:
    return Access(**{"host": "127.0.0.1", "port": 8080, "token": TOKEN} | changes)  # pyright: ignore[reportArgumentType]


def _asked(
    host: str | None, origin: str | None = None, *, query: str = "", cookie: str = "", is_embedded: bool = False
) -> PageRequest:
    return PageRequest(target=f"/{query}", host=host, origin=origin, cookie=cookie, is_embedded=is_embedded)


SERVED = {
    "localhost": ({}, _asked(HERE)),
    "its own page": ({}, _asked(HERE, "http://localhost:8080")),
    "a forwarded port": ({}, _asked("localhost:9000", "http://localhost:9000")),
    "an address": ({}, _asked("127.0.0.1:8080", "http://127.0.0.1:8080")),
    "an address of IPv6": ({}, _asked("[::1]:8080", "http://[::1]:8080")),
    "this machine's name": ({}, _asked(f"{socket.gethostname()}:8080")),
    "capitals and a final dot": ({}, _asked("LocalHost.:8080", "http://localhost.:8080")),
    "the name it binds": ({"host": "localhost"}, _asked("localhost")),
    "a name that is allowed": (PROXIED, _asked("robot.example", "https://robot.example")),
    "an origin that is allowed": (PROXIED, _asked(HERE, "https://studio.example")),
    "the token": (CLOSED, _asked("10.0.0.3:8080", query=f"?token={TOKEN}")),
    "the token among others": (CLOSED, _asked("10.0.0.3:8080", query=f"?a=b&token={TOKEN}")),
    "the token from another page": (PAGE, _asked(HERE, EVIL, query=f"?token={TOKEN}")),
    "the token at a name that is allowed": (PAGE | PROXIED, _asked("robot.example", query=f"?token={TOKEN}")),
    "the cookie at localhost": (PAGE, _asked(HERE, "http://localhost:8080", cookie=KEPT)),
    "the cookie, by a page whose origin is allowed": (
        PAGE | PROXIED,
        _asked(HERE, "https://studio.example", cookie=KEPT),
    ),
    "the cookie": (CLOSED, _asked("10.0.0.3:8080", "http://10.0.0.3:8080", cookie=f"a=b; trundle-8080={TOKEN}")),
}
REFUSED = {
    "another origin": ({}, _asked(HERE, EVIL), "--allow-origin"),
    "another port's origin": ({}, _asked(HERE, "http://localhost:8081"), "--allow-origin"),
    "an image in another page": ({}, _asked(HERE, is_embedded=True), "--allow-origin"),
    "such an image, with the cookie": (
        CLOSED,
        _asked("10.0.0.3:8080", cookie=f"trundle-8080={TOKEN}", is_embedded=True),
        "trundle page link",
    ),
    "a sandbox": ({}, _asked(HERE, "null"), "--allow-origin"),
    "an origin that begins like ours": ({}, _asked(HERE, "http://localhost:8080.evil.example"), "--allow-origin"),
    "rebinding": ({}, _asked("evil.example:8080", "http://evil.example:8080"), "--allow-host"),
    "rebinding, without Origin": ({}, _asked("evil.example:8080"), "--allow-host"),
    "no host": ({}, _asked(None), "--allow-host"),
    "an empty host": ({}, _asked(""), "--allow-host"),
    "a host that is none": ({}, _asked("localhost@evil.example"), "--allow-host"),
    "like an address": ({}, _asked("127.0.0.1.evil.example"), "--allow-host"),
    "a name that is allowed, of another page": (PROXIED, _asked("robot.example", EVIL), "--allow-origin"),
    "no token": (CLOSED, _asked("10.0.0.3:8080", "http://10.0.0.3:8080"), "trundle page link"),
    "no token at localhost": (PAGE, _asked(HERE), "trundle page link"),
    "no token, by its own page": (PAGE, _asked(HERE, "http://localhost:8080"), "trundle page link"),
    "no token, by a page whose origin is allowed": (PAGE | PROXIED, _asked(HERE, "https://studio.example"), "link"),
    "no token off loopback, at localhost": (CLOSED, _asked(HERE), "trundle page link"),
    "the token at a name that leads here": (
        PAGE,
        _asked("evil.example:8080", EVIL, query=f"?token={TOKEN}"),
        "--allow-host",
    ),
    "the cookie of another user's page at this machine": (
        PAGE | {"serves_local_pages": True},
        _asked(HERE, "http://localhost:9999", cookie=KEPT),
        "link",
    ),
    "a wrong token": (CLOSED, _asked(HERE, query="?token=abcdefgi"), "trundle page link"),
    "a token that is no ASCII": (CLOSED, _asked(HERE, query="?token=%C3%A9"), "trundle page link"),
    "a cookie of bytes that are no text": (CLOSED, _asked(HERE, cookie="trundle-8080=\udcff"), "trundle page link"),
    "allowed, without a token": ({**PROXIED, **CLOSED}, _asked(HERE, "https://studio.example"), "trundle page link"),
    "a cookie of another port": (CLOSED, _asked(HERE, cookie=f"trundle-8081={TOKEN}"), "trundle page link"),
    "a cookie that a page of another port has the browser send": (
        CLOSED,
        _asked("10.0.0.3:8080", "http://10.0.0.3:9999", cookie=f"trundle-8080={TOKEN}"),
        "trundle page link",
    ),
}


@pytest.mark.parametrize(("access", "request_"), SERVED.values(), ids=SERVED)
def test_these_are_served(access: dict[str, object], request_: PageRequest) -> None:
    assert _access(**access).refusal(request_) is None


@pytest.mark.parametrize(("access", "request_", "way_out"), REFUSED.values(), ids=REFUSED)
def test_these_are_refused_with_the_way_out(access: dict[str, object], request_: PageRequest, way_out: str) -> None:
    why = _access(**access).refusal(request_)
    assert why is not None
    assert way_out in why.text


@pytest.mark.parametrize(
    ("request_", "is_guess"),
    [
        (_asked(HERE), False),
        (_asked(HERE, query="?token="), False),
        (_asked(HERE, cookie="trundle-8081=guess"), False),
        (_asked(HERE, query="?token=guess"), True),
        (_asked(HERE, cookie="trundle-8080=guess"), True),
        (_asked(HERE, EVIL, cookie=KEPT), True),
    ],
)
def test_a_request_with_a_wrong_token_is_known_as_a_guess(request_: PageRequest, is_guess: bool) -> None:
    refusal = _access(**PAGE).refusal(request_)
    assert refusal is not None
    assert (refusal.asks_token, refusal.is_guess) == (True, is_guess)


def test_a_log_gets_no_tokens() -> None:
    text = f"see it at http://h:1/?token={TOKEN} and ws://h:1/?a=b&token={TOKEN}, page"
    assert without_tokens(text) == "see it at http://h:1/?token=… and ws://h:1/?a=b&token=…, page"


def test_the_token_comes_back_as_a_cookie_that_scripts_and_other_sites_do_not_have() -> None:
    access = _access(**CLOSED)
    with_token, without = _asked(HERE, query=f"?token={TOKEN}"), _asked(HERE, cookie=f"trundle-8080={TOKEN}")

    assert access.answer_fields(with_token)["Set-Cookie"] == f"trundle-8080={TOKEN}; Path=/; HttpOnly; SameSite=Strict"
    assert "Set-Cookie" not in access.answer_fields(without)


def test_other_pages_cannot_frame_it_and_it_talks_to_its_own_server_alone() -> None:
    policy = _access().answer_fields(_asked(HERE))["Content-Security-Policy"]

    assert "frame-ancestors 'self';" in policy
    assert "connect-src 'self' data: blob: ws://localhost:8080 wss://localhost:8080;" in policy


def test_an_origin_that_is_allowed_may_frame_it() -> None:
    assert (
        "frame-ancestors 'self' https://studio.example;"
        in (_access(**PROXIED).answer_fields(_asked(HERE))["Content-Security-Policy"])
    )


def test_the_address_carries_the_token_where_that_is_asked_for() -> None:
    assert _access(**PAGE).url("127.0.0.1", 8080) == f"http://127.0.0.1:8080/?token={TOKEN}"
    assert _access().url("127.0.0.1", 8080) == "http://127.0.0.1:8080"
    assert _access(**CLOSED).url("::1", 8081) == f"http://[::1]:8081/?token={TOKEN}"


def test_tokens_are_long_and_new_each_time() -> None:
    assert len({Access(host="127.0.0.1", port=1).token for _ in range(10)}) == 10
    assert all(len(Access(host="127.0.0.1", port=1).token) >= 20 for _ in range(10))


@pytest.mark.parametrize(
    ("host", "loopback"),
    [("127.0.0.1", True), ("127.9.9.9", True), ("::1", True), ("localhost", True)]
    + [(host, False) for host in ("", "0.0.0.0", "::", "10.0.0.3", "127.evil.example", "localhost.evil.example")],
)
def test_loopback_is_an_address_or_localhost(host: str, loopback: bool) -> None:
    assert is_loopback(host) is loopback


@pytest.mark.parametrize("origin", ["robot.example", "*", "https://a b", "https://a;script-src *", "file://", "null"])
def test_an_origin_that_is_none_is_named(origin: str) -> None:
    with pytest.raises(UsageError, match="not the origin of a web page"):
        AllowedNames(origins=(origin,))


@pytest.mark.parametrize("host", ["", "http://robot", "a/b", "a b"])
def test_a_host_that_is_none_is_named(host: str) -> None:
    with pytest.raises(UsageError, match="not the name of a host"):
        AllowedNames(hosts=(host,))


LOOK = "lookonly"
VIEW: dict[str, object] = {"view_token": LOOK, "needs_token": True}
LOOK_KEPT = f"trundle-8080-view={LOOK}"
OWN = "http://localhost:8080"
RIGHTS = {
    "loopback": (VIEW, _asked(HERE), None),
    "loopback, by a link for looking": (VIEW, _asked(HERE, query=f"?token={LOOK}"), True),
    "a page for looking, beside one that controls": (
        VIEW,
        _asked(HERE, OWN, query="?view_only", cookie=f"{LOOK_KEPT}; {KEPT}"),
        True,
    ),
    "one that controls, and looks": (VIEW, _asked(HERE, OWN, query="?view_only", cookie=KEPT), True),
    "the token, to look": (VIEW, _asked(HERE, query=f"?view_only=&token={TOKEN}"), True),
    "looking, without a token": (VIEW, _asked(HERE, query="?view_only"), None),
    "the token": (CLOSED | VIEW, _asked(HERE, query=f"?token={TOKEN}"), False),
    "the other token": (CLOSED | VIEW, _asked(HERE, query=f"?token={LOOK}"), True),
    "its cookie": (CLOSED | VIEW, _asked(HERE, "http://localhost:8080", cookie=f"trundle-8080-view={LOOK}"), True),
    "both cookies": (
        CLOSED | VIEW,
        _asked(HERE, "http://localhost:8080", cookie=f"trundle-8080-view={LOOK}; trundle-8080={TOKEN}"),
        False,
    ),
    "its cookie under the other name": (CLOSED | VIEW, _asked(HERE, cookie=f"trundle-8080={LOOK}"), None),
    "its cookie, by another page": (CLOSED | VIEW, _asked(HERE, EVIL, cookie=f"trundle-8080-view={LOOK}"), None),
    "a name of ours off loopback, with its cookie": (CLOSED | VIEW, _asked("pc.example:8080", cookie=LOOK_KEPT), True),
    "no such token": (CLOSED, _asked(HERE, query=f"?token={LOOK}"), None),
    "an empty token": (CLOSED, _asked(HERE, query="?token="), None),
}


@pytest.mark.parametrize(("access", "request_", "is_view_only"), RIGHTS.values(), ids=RIGHTS)
def test_a_link_for_looking_gives_no_other_right(
    access: dict[str, object], request_: PageRequest, is_view_only: bool | None
) -> None:
    """None: it is refused."""
    rules = _access(**access)
    assert (rules.refusal(request_) is not None) == (is_view_only is None)
    if is_view_only is not None:
        assert rules.is_view_only(request_) == is_view_only


def test_the_token_for_looking_has_a_link_and_a_cookie_of_its_own() -> None:
    access = _access(**VIEW)
    fields = access.answer_fields(_asked(HERE, query=f"?token={LOOK}"))
    assert access.view_url("127.0.0.1", 8080) == f"http://127.0.0.1:8080/?token={LOOK}"
    assert fields["Set-Cookie"] == f"trundle-8080-view={LOOK}; Path=/; HttpOnly; SameSite=Strict"
