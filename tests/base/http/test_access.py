"""Requests that the page serves or refuses, without sockets; tests/page/http/test_server.py has those."""

import socket

import pytest

from trundle.base.diagnostics import UsageError
from trundle.base.http.access import Access, PageRequest, without_tokens
from trundle.base.http.page_address import AllowedNames, is_loopback, network_addresses

HERE = "localhost:8080"
EVIL = "http://evil.example"
TOKEN = "abcdefgh"
CLOSED = {"host": "0.0.0.0"}
PAGE = {"needs_token": True}
COOKIE = f"trundle-8080={TOKEN}"
PROXIED = {"allowed": AllowedNames(hosts=("robot.example",), origins=("https://studio.example",))}


def _access(**changes: object) -> Access:
    return Access(**{"host": "127.0.0.1", "port": 8080, "token": TOKEN} | changes)  # pyright: ignore[reportArgumentType]


def _request(
    host: str | None, origin: str | None = None, *, query: str = "", cookie: str = "", is_embedded: bool = False
) -> PageRequest:
    return PageRequest(target=f"/{query}", host=host, origin=origin, cookie=cookie, is_embedded=is_embedded)


SERVED = {
    "localhost": ({}, _request(HERE)),
    "its own page": ({}, _request(HERE, "http://localhost:8080")),
    "a forwarded port": ({}, _request("localhost:9000", "http://localhost:9000")),
    "an address": ({}, _request("127.0.0.1:8080", "http://127.0.0.1:8080")),
    "an address of IPv6": ({}, _request("[::1]:8080", "http://[::1]:8080")),
    "this machine's name": ({}, _request(f"{socket.gethostname()}:8080")),
    "capitals and a final dot": ({}, _request("LocalHost.:8080", "http://localhost.:8080")),
    "the bound name": ({"host": "localhost"}, _request("localhost")),
    "an allowed name": (PROXIED, _request("robot.example", "https://robot.example")),
    "an allowed origin": (PROXIED, _request(HERE, "https://studio.example")),
    "the token": (CLOSED, _request("10.0.0.3:8080", query=f"?token={TOKEN}")),
    "the token among others": (CLOSED, _request("10.0.0.3:8080", query=f"?a=b&token={TOKEN}")),
    "the token from another page": (PAGE, _request(HERE, EVIL, query=f"?token={TOKEN}")),
    "the token at an allowed name": (PAGE | PROXIED, _request("robot.example", query=f"?token={TOKEN}")),
    "the cookie at localhost": (PAGE, _request(HERE, "http://localhost:8080", cookie=COOKIE)),
    "the cookie, by a page of an allowed origin": (
        PAGE | PROXIED,
        _request(HERE, "https://studio.example", cookie=COOKIE),
    ),
    "the cookie": (CLOSED, _request("10.0.0.3:8080", "http://10.0.0.3:8080", cookie=f"a=b; trundle-8080={TOKEN}")),
}
REFUSED = {
    "another origin": ({}, _request(HERE, EVIL), "--allow-origin"),
    "another port's origin": ({}, _request(HERE, "http://localhost:8081"), "--allow-origin"),
    "an image in another page": ({}, _request(HERE, is_embedded=True), "--allow-origin"),
    "such an image, with the cookie": (
        CLOSED,
        _request("10.0.0.3:8080", cookie=f"trundle-8080={TOKEN}", is_embedded=True),
        "trundle page link",
    ),
    "a sandbox": ({}, _request(HERE, "null"), "--allow-origin"),
    "an origin that begins like the server's": (
        {},
        _request(HERE, "http://localhost:8080.evil.example"),
        "--allow-origin",
    ),
    "rebinding": ({}, _request("evil.example:8080", "http://evil.example:8080"), "--allow-host"),
    "rebinding, without Origin": ({}, _request("evil.example:8080"), "--allow-host"),
    "no host": ({}, _request(None), "--allow-host"),
    "an empty host": ({}, _request(""), "--allow-host"),
    "an invalid host": ({}, _request("localhost@evil.example"), "--allow-host"),
    "a host that resembles an address": ({}, _request("127.0.0.1.evil.example"), "--allow-host"),
    "an allowed name, by another page": (PROXIED, _request("robot.example", EVIL), "--allow-origin"),
    "no token": (CLOSED, _request("10.0.0.3:8080", "http://10.0.0.3:8080"), "trundle page link"),
    "no token at localhost": (PAGE, _request(HERE), "trundle page link"),
    "no token, by its own page": (PAGE, _request(HERE, "http://localhost:8080"), "trundle page link"),
    "no token, by a page of an allowed origin": (PAGE | PROXIED, _request(HERE, "https://studio.example"), "link"),
    "no token off loopback, at localhost": (CLOSED, _request(HERE), "trundle page link"),
    "the token at a rebound name": (
        PAGE,
        _request("evil.example:8080", EVIL, query=f"?token={TOKEN}"),
        "--allow-host",
    ),
    "the cookie of another user's page at this machine": (
        PAGE | {"serves_local_pages": True},
        _request(HERE, "http://localhost:9999", cookie=COOKIE),
        "link",
    ),
    "a wrong token": (CLOSED, _request(HERE, query="?token=abcdefgi"), "trundle page link"),
    "a token that is not ASCII": (CLOSED, _request(HERE, query="?token=%C3%A9"), "trundle page link"),
    "a cookie that is not text": (CLOSED, _request(HERE, cookie="trundle-8080=\udcff"), "trundle page link"),
    "allowed, without a token": ({**PROXIED, **CLOSED}, _request(HERE, "https://studio.example"), "trundle page link"),
    "a cookie of another port": (CLOSED, _request(HERE, cookie=f"trundle-8081={TOKEN}"), "trundle page link"),
    "a cookie sent for a page of another port": (
        CLOSED,
        _request("10.0.0.3:8080", "http://10.0.0.3:9999", cookie=f"trundle-8080={TOKEN}"),
        "trundle page link",
    ),
}


@pytest.mark.parametrize(("access", "request_"), SERVED.values(), ids=SERVED)
def test_request_is_served(access: dict[str, object], request_: PageRequest) -> None:
    assert _access(**access).refusal(request_) is None


@pytest.mark.parametrize(("access", "request_", "advice"), REFUSED.values(), ids=REFUSED)
def test_request_is_refused_with_advice(access: dict[str, object], request_: PageRequest, advice: str) -> None:
    refusal = _access(**access).refusal(request_)
    assert refusal is not None
    assert advice in refusal.text


@pytest.mark.parametrize(
    ("request_", "is_guess"),
    [
        (_request(HERE), False),
        (_request(HERE, query="?token="), False),
        (_request(HERE, cookie="trundle-8081=guess"), False),
        (_request(HERE, query="?token=guess"), True),
        (_request(HERE, cookie="trundle-8080=guess"), True),
        (_request(HERE, EVIL, cookie=COOKIE), True),
    ],
)
def test_a_request_with_a_wrong_token_counts_as_a_guess(request_: PageRequest, is_guess: bool) -> None:
    refusal = _access(**PAGE).refusal(request_)
    assert refusal is not None
    assert (refusal.asks_token, refusal.is_guess) == (True, is_guess)


def test_tokens_are_removed_from_logs() -> None:
    text = f"see it at http://h:1/?token={TOKEN} and ws://h:1/?a=b&token={TOKEN}, page"
    assert without_tokens(text) == "see it at http://h:1/?token=… and ws://h:1/?a=b&token=…, page"


def test_the_token_is_set_as_a_strict_http_only_cookie() -> None:
    access = _access(**CLOSED)
    with_token, without = _request(HERE, query=f"?token={TOKEN}"), _request(HERE, cookie=f"trundle-8080={TOKEN}")

    assert (
        access.response_fields(with_token)["Set-Cookie"] == f"trundle-8080={TOKEN}; Path=/; HttpOnly; SameSite=Strict"
    )
    assert "Set-Cookie" not in access.response_fields(without)


def test_policy_forbids_framing_and_connections_to_other_servers() -> None:
    policy = _access().response_fields(_request(HERE))["Content-Security-Policy"]

    assert "frame-ancestors 'self';" in policy
    assert "connect-src 'self' data: blob: ws://localhost:8080 wss://localhost:8080;" in policy


def test_an_allowed_origin_may_frame_the_page() -> None:
    assert (
        "frame-ancestors 'self' https://studio.example;"
        in (_access(**PROXIED).response_fields(_request(HERE))["Content-Security-Policy"])
    )


def test_url_has_the_token_if_one_is_required() -> None:
    assert _access(**PAGE).url("127.0.0.1", 8080) == f"http://127.0.0.1:8080/?token={TOKEN}"
    assert _access().url("127.0.0.1", 8080) == "http://127.0.0.1:8080"
    assert _access(**CLOSED).url("::1", 8081) == f"http://[::1]:8081/?token={TOKEN}"


def test_tokens_are_long_and_random() -> None:
    assert len({Access(host="127.0.0.1", port=1).token for _ in range(10)}) == 10
    assert all(len(Access(host="127.0.0.1", port=1).token) >= 20 for _ in range(10))


@pytest.mark.parametrize(
    ("host", "loopback"),
    [("127.0.0.1", True), ("127.9.9.9", True), ("::1", True), ("localhost", True)]
    + [(host, False) for host in ("", "0.0.0.0", "::", "10.0.0.3", "127.evil.example", "localhost.evil.example")],
)
def test_loopback_is_an_address_or_localhost(host: str, loopback: bool) -> None:
    assert is_loopback(host) is loopback


@pytest.mark.parametrize(
    ("host", "addresses"),
    [("127.0.0.1", ()), ("localhost", ()), ("::1", ()), ("192.168.7.1", ("192.168.7.1",)), ("box", ("box",))],
)
def test_other_machines_use_the_host_that_is_bound(host: str, addresses: tuple[str, ...]) -> None:
    assert network_addresses(host) == addresses


def test_a_server_at_all_addresses_is_reached_at_those_of_this_machine() -> None:
    for address in network_addresses("0.0.0.0"):
        with socket.create_server((address, 0)):  # it is one of this machine
            assert not is_loopback(address)


@pytest.mark.parametrize("origin", ["robot.example", "*", "https://a b", "https://a;script-src *", "file://", "null"])
def test_an_invalid_origin_is_refused(origin: str) -> None:
    with pytest.raises(UsageError, match="not the origin of a web page"):
        AllowedNames(origins=(origin,))


@pytest.mark.parametrize("host", ["", "http://robot", "a/b", "a b"])
def test_an_invalid_host_is_refused(host: str) -> None:
    with pytest.raises(UsageError, match="not the name of a host"):
        AllowedNames(hosts=(host,))


VIEW_TOKEN = "lookonly"
VIEW: dict[str, object] = {"view_token": VIEW_TOKEN, "needs_token": True}
VIEW_COOKIE = f"trundle-8080-view={VIEW_TOKEN}"
OWN = "http://localhost:8080"
RIGHTS = {
    "loopback": (VIEW, _request(HERE), None),
    "loopback, by a view-only link": (VIEW, _request(HERE, query=f"?token={VIEW_TOKEN}"), True),
    "a view-only page, with both cookies": (
        VIEW,
        _request(HERE, OWN, query="?view_only", cookie=f"{VIEW_COOKIE}; {COOKIE}"),
        True,
    ),
    "a view-only page, with the control cookie": (VIEW, _request(HERE, OWN, query="?view_only", cookie=COOKIE), True),
    "a view-only page, with the control token": (VIEW, _request(HERE, query=f"?view_only=&token={TOKEN}"), True),
    "a view-only page, without a token": (VIEW, _request(HERE, query="?view_only"), None),
    "the token": (CLOSED | VIEW, _request(HERE, query=f"?token={TOKEN}"), False),
    "the view-only token": (CLOSED | VIEW, _request(HERE, query=f"?token={VIEW_TOKEN}"), True),
    "the view-only cookie": (
        CLOSED | VIEW,
        _request(HERE, "http://localhost:8080", cookie=f"trundle-8080-view={VIEW_TOKEN}"),
        True,
    ),
    "both cookies": (
        CLOSED | VIEW,
        _request(HERE, "http://localhost:8080", cookie=f"trundle-8080-view={VIEW_TOKEN}; trundle-8080={TOKEN}"),
        False,
    ),
    "the view-only token in the control cookie": (
        CLOSED | VIEW,
        _request(HERE, cookie=f"trundle-8080={VIEW_TOKEN}"),
        None,
    ),
    "the view-only cookie, by another page": (
        CLOSED | VIEW,
        _request(HERE, EVIL, cookie=f"trundle-8080-view={VIEW_TOKEN}"),
        None,
    ),
    "a name off loopback, with the view-only cookie": (
        CLOSED | VIEW,
        _request("pc.example:8080", cookie=VIEW_COOKIE),
        True,
    ),
    "no such token": (CLOSED, _request(HERE, query=f"?token={VIEW_TOKEN}"), None),
    "an empty token": (CLOSED, _request(HERE, query="?token="), None),
}


@pytest.mark.parametrize(("access", "request_", "is_view_only"), RIGHTS.values(), ids=RIGHTS)
def test_view_only_link_grants_no_other_right(
    access: dict[str, object], request_: PageRequest, is_view_only: bool | None
) -> None:
    """None: it is refused."""
    rules = _access(**access)
    assert (rules.refusal(request_) is not None) == (is_view_only is None)
    if is_view_only is not None:
        assert rules.is_view_only(request_) == is_view_only


def test_the_view_only_token_has_its_own_link_and_cookie() -> None:
    access = _access(**VIEW)
    fields = access.response_fields(_request(HERE, query=f"?token={VIEW_TOKEN}"))
    assert access.view_url("127.0.0.1", 8080) == f"http://127.0.0.1:8080/?token={VIEW_TOKEN}"
    assert fields["Set-Cookie"] == f"trundle-8080-view={VIEW_TOKEN}; Path=/; HttpOnly; SameSite=Strict"
