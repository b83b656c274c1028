"""A user shares the page with a phone: by a QR code, with the right to drive or only to look."""

import io
from collections.abc import Iterator
from typing import Any

import pytest
import zxingcpp
from PIL import Image
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser

from trundle.base.http.page_address import PageAddress, network_addresses
from trundle.page import PageServer, Session

pytestmark = [pytest.mark.slow, needs_client]

SESSION = Session(title="t", kind="graph")


@pytest.fixture
def page(request: pytest.FixtureRequest) -> Iterator[PageServer]:
    with PageServer.start(SESSION, at=PageAddress(host=request.param, port=0)) as page:
        yield page


@pytest.fixture
def user(chromium: Any, page: PageServer) -> Iterator[PanelUser]:
    user = PanelUser(chromium, page.url)
    user.page.keyboard.press("Control+k")
    user.page.get_by_role("combobox", name="Search commands").fill("Share")
    user.page.keyboard.press("Enter")
    yield user
    user.close()


def _scanned(user: PanelUser) -> str:
    """Return the text of the dialog's QR code, read from a screenshot."""
    picture = user.page.get_by_role("img", name="Link as a QR code").screenshot()
    (code,) = zxingcpp.read_barcodes(Image.open(io.BytesIO(picture)))
    return code.text


@pytest.mark.parametrize("page", ["0.0.0.0"], indirect=True)
def test_a_phone_scans_a_link_that_drives_or_only_looks(user: PanelUser, chromium: Any, page: PageServer) -> None:
    addresses = network_addresses("0.0.0.0")
    if not addresses:
        pytest.skip("this machine is on no network")
    control = _scanned(user)
    user.page.get_by_role("button", name="View only").click()
    user.page.get_by_text("can neither drive nor change anything").wait_for()
    look = _scanned(user)

    assert control == page.url.replace("127.0.0.1", addresses[0])
    assert look == page.view_url.replace("127.0.0.1", addresses[0])
    for link, count in ((control, 0), (look, 1)):
        phone = PanelUser(chromium, link)
        phone.page.get_by_role("heading", name="t").wait_for()
        assert phone.page.get_by_text("View only").count() == count
        phone.close()


@pytest.mark.parametrize("page", ["127.0.0.1"], indirect=True)
def test_without_a_network_the_dialog_says_how_others_reach_the_page(user: PanelUser) -> None:
    user.page.get_by_text("start Trundle with --host 0.0.0.0").wait_for()
    assert user.page.get_by_role("img", name="Link as a QR code").count() == 0
