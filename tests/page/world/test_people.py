"""People at one page, as the protocol shows them to each other."""

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


def test_each_sees_who_is_there_and_what_they_selected(page: PageServer) -> None:
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


def test_a_number_is_free_again_when_its_person_has_left(page: PageServer) -> None:
    with _join(page.url) as one, _join(page.url) as two:
        one.socket.close()
        two.until(lambda: [person["number"] for person in _people(two)["people"]] == [2])
        with _join(page.url) as three:
            assert _people(three)["you"] == 1


def test_who_only_speaks_the_protocol_is_not_counted(page: PageServer) -> None:
    with _join(page.url) as one, ProtocolClient(page.url) as silent:
        silent.until(lambda: silent.channels)
        silent.send("trundle/presence", selection={"kind": "model", "model": "cart"})
        one.send("trundle/presence", selection={"kind": "model", "model": "cart"})
        one.until(lambda: _people(one)["people"][0]["selection"] is not None)
        assert len(_people(one)["people"]) == 1


def test_what_is_no_selection_is_refused_in_words(page: PageServer) -> None:
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
