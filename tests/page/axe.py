"""Accessibility of a page as Axe finds it."""

from pathlib import Path
from typing import Any

import pytest

_AXE = Path(__file__).parents[2] / "web/node_modules/axe-core/axe.min.js"
_IS_MOVING = "document.getAnimations().some((animation) => animation instanceof CSSTransition)"
"""A button between two looks has the colors of neither."""
needs_axe = pytest.mark.skipif(not _AXE.is_file(), reason="axe-core is not installed in web/node_modules")


def load_axe(tab: Any) -> None:
    """Load Axe through the debugger, as the page's policy forbids inline scripts."""
    tab.evaluate(_AXE.read_text())


def assert_accessible(tab: Any, state: str) -> None:
    """Assert that Axe finds nothing, not even of minor impact; `state` begins each line of the error."""
    while tab.evaluate(_IS_MOVING):
        tab.wait_for_timeout(50)
    violations = tab.evaluate("axe.run().then((result) => result.violations)")
    found = [f"{state}: {one['impact']}: {one['help']}: {node['html']}" for one in violations for node in one["nodes"]]
    assert not found, "\n".join(found)
