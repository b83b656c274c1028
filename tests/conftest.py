"""Fixtures of all tests."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from trundle.robots import packages

_SHARED = Path(__file__).resolve().parents[2] / "shared"
_VARIABLES = ("ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME", "ROS_NAMESPACE", packages.ALLOW_OUTSIDE, packages.LENIENT)
"""Variables that a user's shell may set, and that commands in this process set."""
_INSTALLED_PACKAGES = {
    "trundle.robots.packages.ros_packages._INSTALLED": Path("/nowhere"),
    "trundle.ros.messages.definition_search.DEBIAN_SHARE": "",
}
"""Folders of Debian's ROS packages, which are searched last → replacements that hide them."""
_CHROMIUM = Path("/usr/bin/chromium")
_SOFTWARE_GL = (
    "--no-sandbox",
    "--disable-gpu",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-features=WebUIOmniboxPopup,WebUIOmniboxAimPopup,WebUIOmniboxFullPopup",  # additional pages per window
)


def pytest_configure() -> None:
    """Make tests repeatable, and reset signals that background jobs and nohup ignore and child processes inherit."""
    for variable in _VARIABLES:
        os.environ.pop(variable, None)
    os.environ["XDG_DATA_HOME"] = os.devnull  # hides packages that the user has fetched
    # Tests are the same on each run and on a slow machine; `--hypothesis-profile default` draws new examples.
    quiet = [HealthCheck.too_slow, HealthCheck.function_scoped_fixture]
    settings.register_profile("steady", deadline=None, derandomize=True, suppress_health_check=quiet)
    settings.load_profile("steady")
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
        signal.signal(signal.SIGHUP, signal.SIG_DFL)


@pytest.fixture(autouse=True)
def _no_installed_packages(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Hide installed ROS packages, message definitions and rules from tests that do not use ROS' tools."""
    if request.node.get_closest_marker("real_ros") is None:
        for name, replacement in _INSTALLED_PACKAGES.items():
            monkeypatch.setattr(name, replacement)


@pytest.fixture(autouse=True)
def _commands_leave_no_variables(monkeypatch: pytest.MonkeyPatch) -> None:
    for variable in _VARIABLES:
        monkeypatch.setenv(variable, "")  # so that monkeypatch restores it
        monkeypatch.delenv(variable)


@pytest.fixture(scope="session")
def shared() -> Path:
    """Folder of published robots and reference data next to the checkout."""
    if not (_SHARED / "seeds").is_dir():
        pytest.skip("the published robots (../shared) are not beside this checkout")
    return _SHARED


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """Start a real browser with software rendering.

    Module scope: Playwright's event loop in this thread conflicts with asyncio.run of other tests.
    """
    if not _CHROMIUM.exists():
        pytest.skip(f"{_CHROMIUM} is not installed")
    api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    with api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(_CHROMIUM), args=list(_SOFTWARE_GL))
        yield browser
        browser.close()
