"""The benchmark of the pointer in a world of 200 models runs; `make bench` reports its figures."""

from typing import Any

import pytest
from bench.page_pointer import measure
from tests.page.built_client import needs_client

pytestmark = [pytest.mark.slow, needs_client]


def test_hovering_selecting_and_dragging_are_measured(chromium: Any) -> None:
    shares = measure(chromium)

    assert set(shares) == {"hover", "select", "drag"}
    assert all(share > 0 for share in shares.values())
