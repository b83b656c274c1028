"""Fixtures every room's tests share."""

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
"""A user's shell may have set them, and commands that run in this process set them."""
_INSTALLED_PACKAGES = {
    "trundle.robots.packages.ros_packages._INSTALLED": Path("/nowhere"),
    "trundle.ros.messages.definition_search.DEBIAN_SHARE": "",
}
"""Folders of Debian's packages of ROS, which are searched last, and what hides them."""
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
    "--disable-features=WebUIOmniboxPopup,WebUIOmniboxAimPopup,WebUIOmniboxFullPopup",  # pages of its own per window
)


def pytest_configure() -> None:
    """Make tests repeatable, and reset signals that programs would inherit as ignored from background jobs or nohup."""
    for variable in _VARIABLES:
        os.environ.pop(variable, None)
    os.environ["XDG_DATA_HOME"] = os.devnull  # packages that the user has fetched are not the tests'
    # Tests are the same on each run and on a slow machine; `--hypothesis-profile default` draws new examples.
    quiet = [HealthCheck.too_slow, HealthCheck.function_scoped_fixture]
    settings.register_profile("steady", deadline=None, derandomize=True, suppress_health_check=quiet)
    settings.load_profile("steady")
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
        signal.signal(signal.SIGHUP, signal.SIG_DFL)


@pytest.fixture(autouse=True)
def _no_installed_packages(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:  # pyright: ignore[reportUnusedFunction]
    """Hide the machine's packages of ROS, their message definitions and rules, from tests without its tools."""
    if request.node.get_closest_marker("real_ros") is None:
        for name, nothing in _INSTALLED_PACKAGES.items():
            monkeypatch.setattr(name, nothing)


@pytest.fixture(autouse=True)
def _commands_leave_no_variables(monkeypatch: pytest.MonkeyPatch) -> None:  # pyright: ignore[reportUnusedFunction]
    for variable in _VARIABLES:
        monkeypatch.setenv(variable, "")  # so that it is taken back, whatever the test does
        monkeypatch.delenv(variable)


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of published robots and reference figures beside the checkout."""
    if not (_SHARED / "seeds").is_dir():
        pytest.skip("the published robots (../shared) are not beside this checkout")
    return _SHARED


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """Start a real browser with software rendering.

    For one module: Playwright keeps an event loop running in this thread, which asyncio.run of other tests refuses.
    """
    if not _CHROMIUM.exists():
        pytest.skip(f"{_CHROMIUM} is not installed")
    api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    with api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(_CHROMIUM), args=list(_SOFTWARE_GL))
        yield browser
        browser.close()
