"""The benchmark of busy pages runs; `make bench` reports its figures."""

from typing import Any

import pytest
from bench.page_frames import measure
from tests.page.built_client import needs_client

pytestmark = [pytest.mark.slow, needs_client]


def test_a_cloud_topics_and_models_are_measured(chromium: Any) -> None:
    found = measure(chromium)

    assert len(found) == 3
    assert all(milliseconds > 0 for milliseconds in found.values())
