"""Users of one page, as the protocol lists them."""

import json
from typing import Any

from tests.page_client import ProtocolClient

from trundle.page import PageServer


def _people(client: ProtocolClient) -> dict[str, Any]:
    payloads = client.payloads("trundle/people")
    return json.loads(payloads[-1]) if payloads else {"people": []}


def _join(url: str) -> ProtocolClient:
    client = ProtocolClient(url)
    client.subscribe("trundle/people")
    client.until(lambda: _people(client)["people"])
    return client


def test_clients_get_the_list_of_users_and_their_selections(page: PageServer) -> None:
    link = {"kind": "link", "model": "cart", "link": "base"}
    with _join(page.url) as one, _join(page.view_url) as two:
        one.send("trundle/presence", selection=link)
        two.send("trundle/presence", selection={"kind": "light", "light": "sun"})
        expected = [
            {"number": 1, "view_only": False, "selection": link},
            {"number": 2, "view_only": True, "selection": {"kind": "light", "light": "sun"}},
        ]
        one.until(lambda: _people(one)["people"] == expected)
        two.until(lambda: _people(two)["people"] == expected)
        assert (_people(one)["you"], _people(two)["you"]) == (1, 2)
        one.send("trundle/presence", selection=None)
        two.until(lambda: _people(two)["people"][0]["selection"] is None)


def test_numbers_of_users_who_left_are_reused(page: PageServer) -> None:
    with _join(page.url) as one, _join(page.url) as two:
        one.socket.close()
        two.until(lambda: [person["number"] for person in _people(two)["people"]] == [2])
        with _join(page.url) as three:
            assert _people(three)["you"] == 1


def test_foxglove_clients_are_not_listed(page: PageServer) -> None:
    with _join(page.url) as one, ProtocolClient(page.url) as silent:
        silent.until(lambda: silent.channels)
        silent.send("trundle/presence", selection={"kind": "model", "model": "cart"})
        one.send("trundle/presence", selection={"kind": "model", "model": "cart"})
        one.until(lambda: _people(one)["people"][0]["selection"] is not None)
        assert len(_people(one)["people"]) == 1


def test_invalid_selections_are_refused_with_a_reason(page: PageServer) -> None:
    selections: list[Any] = [
        1,
        {"kind": "robot"},
        {"kind": "model", "model": "x" * 1001},
        {"kind": "model", "html": ""},
    ]
    with _join(page.url) as one:
        for number, selection in enumerate(selections, 1):
            one.send("trundle/presence", selection=selection)
            one.until(lambda number=number: len(one.statuses) == number)
        assert all(status["message"].startswith("a message cannot be read: ") for status in one.statuses)
        assert _people(one)["people"][0]["selection"] is None
