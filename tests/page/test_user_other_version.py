"""Page and server are of different versions: a notice names the invalid message."""

from typing import Any

import msgspec
import pytest
from tests.manifests import empty_manifest
from tests.page.built_client import needs_client
from tests.page.panel_user import PATIENCE_MS

from trundle.page import PageServer
from trundle.page.world.manifest import Manifest, PhysicsSettings

pytestmark = [needs_client, pytest.mark.slow, pytest.mark.browser]
_VERSION = "The server may be of another version: load the page again."


class OtherManifest(Manifest, frozen=True, kw_only=True):
    """Manifest of another version, which names a field differently."""

    physics: PhysicsSettings = msgspec.field(name="dynamics")


@pytest.fixture
def tab(chromium: Any) -> Any:
    tab = chromium.new_page()
    tab.set_default_timeout(PATIENCE_MS)
    yield tab
    tab.close()


def test_a_world_of_another_version_causes_a_notice(page: PageServer, tab: Any) -> None:
    page.set_world(msgspec.convert(empty_manifest(1), OtherManifest, from_attributes=True), {})
    errors: list[Any] = []
    tab.on("pageerror", lambda error: errors.append(error))

    tab.goto(page.url)

    tab.get_by_text(f"The page cannot read trundle/world: 'physics' is missing. {_VERSION}").first.wait_for()
    assert errors == []


def test_a_session_of_another_version_replaces_the_page_by_a_message(page: PageServer, tab: Any) -> None:
    def without_title(route: Any) -> None:
        answer = route.fetch()
        fields = answer.json()
        del fields["title"]
        route.fulfill(response=answer, json=fields)

    tab.route("**/session.json*", without_title)
    tab.goto(page.url)

    alert = tab.get_by_role("alert")
    alert.wait_for()
    assert alert.inner_text().startswith(
        f"The page cannot be shown: The page cannot read the session: 'title' is missing. {_VERSION}"
    )
