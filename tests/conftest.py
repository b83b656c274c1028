"""Fixtures every room's tests share."""

from pathlib import Path

import pytest

_SHARED = Path(__file__).resolve().parents[2] / "shared"


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of published robots and reference figures beside the checkout."""
    if not (_SHARED / "seeds").is_dir():
        pytest.skip("the published robots (../shared) are not beside this checkout")
    return _SHARED
