"""Pages for tests: one without a graph, shared by a module."""

from collections.abc import Iterator

import pytest

from trundle.page import PageServer, Session
from trundle.page_address import PageAddress


@pytest.fixture(scope="module")
def page() -> Iterator[PageServer]:
    with PageServer.start(Session(title="test", kind="simulation", robot="cart"), at=PageAddress(port=0)) as page:
        yield page
