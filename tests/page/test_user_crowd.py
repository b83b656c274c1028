"""Ten users of one simulation: one in a browser, nine over the protocol, one of them view-only."""

import json
from collections.abc import Iterator
from contextlib import ExitStack
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.world_user import WorldUser
from tests.page_client import ProtocolClient
from tests.system.browser import running_page

pytestmark = [needs_client, pytest.mark.slow]
MODELS = tuple(f"crate_{number}" for number in range(1, 10))
BOX = "<geometry><box><size>0.3 0.3 0.3</size></box></geometry>"
LINK = f'<link name="base"><collision name="c">{BOX}</collision><visual name="v">{BOX}</visual></link>'
WORLD = f"""<sdf version="1.6"><world name="yard">{
    "".join(f'<model name="{name}"><pose>{i - 4} 0 0.2 0 0 0</pose>{LINK}</model>' for i, name in enumerate(MODELS))
}</world></sdf>"""


@pytest.fixture(scope="module")
def user(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[WorldUser]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--no-ros", "--pause", "--port", "0", "--view-only")
    with running_page(*words, environment={"HOME": str(folder)}, folder=folder) as url:
        user = WorldUser(chromium, url)
        yield user
        user.close()


def _people(client: ProtocolClient) -> list[dict[str, Any]]:
    payloads = client.payloads("trundle/people")
    return json.loads(payloads[-1])["people"] if payloads else []


def _link(user: WorldUser, kind: str) -> str:
    user.button("Search commands, Ctrl K").click()
    user.page.get_by_role("combobox", name="Search commands").fill("share")
    user.page.keyboard.press("Enter")
    user.button(kind).click()
    link = user.field("Link").input_value()
    user.page.keyboard.press("Escape")
    return str(link).partition("#")[0]


def test_ten_users_see_all_selections_and_a_view_only_one_changes_nothing(user: WorldUser) -> None:
    control, look = _link(user, "View and control"), _link(user, "View only")
    with ExitStack() as stack:
        others = [stack.enter_context(ProtocolClient(url)) for url in (*[control] * 8, look)]
        for other, model in zip(others, MODELS, strict=True):
            other.subscribe("trundle/people")
            other.send("trundle/presence", selection={"kind": "model", "model": model})
        user.button("10 people").wait_for()
        user.pick("crate_1")
        for other in others:
            other.until(lambda: [bool(person["selection"]) for person in _people(other)] == [True] * 10)  # noqa: B023
            chosen = sorted(person["selection"]["model"] for person in _people(other))
            assert chosen == sorted(("crate_1", *MODELS))
            assert [person["view_only"] for person in _people(other)].count(True) == 1
        user.button("10 people").click()
        listed = user.page.get_by_role("menu").inner_text()
        assert listed.count("Person") == 10
        assert listed.count("view only") == 1
        user.page.keyboard.press("Escape")

        looker = others[-1]
        for number, request in enumerate(({"request": "play"}, {"request": "delete", "model": "crate_2"})):
            looker.send("trundle/request", id=number, **request)
            looker.until(lambda: looker.last("trundle/response").get("id") == number)  # noqa: B023
            assert looker.last("trundle/response")["ok"] is False
        assert user.is_paused
        assert {model["name"] for model in user.manifest()["models"]} == set(MODELS)
    user.page.get_by_role("button", name="10 people").wait_for(state="detached")
