"""Pages for tests: one without a graph, shared by a module."""

from collections.abc import Iterator

import pytest

from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session


@pytest.fixture(scope="module")
def page() -> Iterator[PageServer]:
    with PageServer.start(Session(title="test", kind="simulation", robot="cart"), at=PageAddress(port=0)) as page:
        yield page
