"""The link in a browser: its token moves from the address into a cookie; without a token the page asks for the link."""

from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

import pytest
from tests.page.built_client import needs_client

from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session
from trundle.page.browser import write_redirect

pytestmark = needs_client
PATIENCE_MS = 60_000


@pytest.fixture(scope="module")
def page() -> Iterator[PageServer]:
    with PageServer.start(Session(title="cart", kind="simulation"), at=PageAddress(port=0)) as page:
        yield page


@pytest.fixture
def browser(chromium: Any) -> Iterator[Any]:
    context = chromium.new_context()
    context.set_default_timeout(PATIENCE_MS)
    yield context
    context.close()


def _bare(page: PageServer) -> str:
    return page.url.partition("?")[0]


def test_the_token_moves_from_the_address_into_a_cookie(page: PageServer, browser: Any) -> None:
    """The page is opened by the file that Trundle writes, and works after a reload."""
    token = page.url.partition("token=")[2]
    tab = browser.new_page()
    requests: list[Any] = []
    tab.on("request", lambda request: requests.append(request))
    file = write_redirect(page.url)
    assert file is not None
    tab.goto(file.as_uri())
    tab.get_by_label("Connected").first.wait_for()

    assert tab.url == _bare(page)
    assert token not in tab.title()
    (cookie,) = browser.cookies()
    assert (cookie["name"], cookie["value"]) == (f"trundle-{urlsplit(page.url).port}", token)
    assert (cookie["httpOnly"], cookie["sameSite"]) == (True, "Strict")
    assert [request.headers["referer"] for request in requests if token in request.headers.get("referer", "")] == []
    with_token = [request.url for request in requests if token in request.url]
    assert {urlsplit(url).path for url in with_token} == {"/", "/session.json"}
    tab.reload()
    tab.get_by_label("Connected").first.wait_for()
    file.unlink()


def test_a_view_only_link_is_view_only_in_a_browser_with_full_access(page: PageServer, browser: Any) -> None:
    owner, viewer = browser.new_page(), browser.new_page()
    owner.goto(page.url)
    owner.get_by_label("Connected").first.wait_for()
    viewer.goto(page.view_url)
    viewer.get_by_text("View only").first.wait_for()
    assert viewer.url == f"{_bare(page)}?view_only"
    viewer.reload()
    viewer.get_by_text("View only").first.wait_for()
    owner.reload()
    owner.get_by_label("Connected").first.wait_for()
    assert owner.get_by_text("View only").count() == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_without_the_token_the_page_asks_for_the_link(page: PageServer, chromium: Any, scheme: str) -> None:
    """The document fits a phone's width, too, and loads no other file."""
    context = chromium.new_context(color_scheme=scheme, viewport={"width": 390, "height": 700})
    tab = context.new_page()
    requests: list[str] = []
    tab.on("request", lambda request: requests.append(request.url))
    answer = tab.goto(_bare(page))

    assert answer.status == 403
    assert tab.get_by_text("trundle page link").is_visible()
    assert tab.evaluate("document.documentElement.scrollWidth") == 390
    color = tab.evaluate("getComputedStyle(document.body).backgroundColor")
    assert color == {"light": "rgb(246, 247, 248)", "dark": "rgb(22, 25, 28)"}[scheme]
    assert set(requests) <= {_bare(page), f"{_bare(page)}favicon.ico"}
    context.close()


def test_a_link_on_another_site_opens_the_page_again(page: PageServer, browser: Any) -> None:
    """SameSite=Strict keeps the cookie from other sites' links."""
    owner = browser.new_page()
    owner.goto(page.url)
    owner.get_by_label("Connected").first.wait_for()
    tab = browser.new_page()
    tab.route("http://wiki.example/", lambda route: route.fulfill(body=f'<a href="{_bare(page)}">robot</a>'))
    tab.goto("http://wiki.example/")
    tab.set_content(f'<a href="{_bare(page)}">robot</a>')
    tab.get_by_text("robot").click()
    tab.get_by_text("Open it again").click()
    tab.get_by_label("Connected").first.wait_for()
