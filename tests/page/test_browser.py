"""The page opens automatically for a user with a terminal and a browser."""

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from tests.graphs import until
from tests.ros.shell.terminal import Terminal

from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session
from trundle.page.browser import announce_page, has_browser

RUN = (sys.executable, "-m", "trundle", "run", "model://rp2w", "--no-ros", "--no-sensors", "--port", "0")
SHORT = ("--duration", "0.2", "--speed", "max")


@pytest.fixture
def opened(tmp_path: Path) -> Path:
    """File of the URLs that the browser opened, one per line."""
    browser = tmp_path / "browser"
    browser.write_text(f'#!/bin/sh\necho "$1" >> {tmp_path}/opened\n')
    browser.chmod(0o755)
    return tmp_path / "opened"


@pytest.fixture
def env(opened: Path) -> Mapping[str, str]:
    return {**os.environ, "BROWSER": str(opened.with_name("browser"))}


def test_the_page_opens_from_a_terminal(env: Mapping[str, str], opened: Path, tmp_path: Path) -> None:
    with Terminal(RUN, env, tmp_path) as terminal:
        terminal.expect("see it at ")
        url = re.search(r"http://\S+", terminal.expect("\n"))
        until(lambda: opened.exists() and opened.read_text().endswith("\n"))

        assert url is not None
        (shown,) = opened.read_text().split()
        file = Path(urlsplit(shown).path)
        assert shown.startswith("file://")  # everybody can read the arguments of a process
        assert file.stat().st_mode & 0o777 == 0o600
        assert f'url={url[0]}"' in file.read_text()

        terminal.keys("\x03")
        assert terminal.wait() == 130
    assert not file.exists()


def test_an_option_only_prints_the_url(env: Mapping[str, str], opened: Path, tmp_path: Path) -> None:
    with Terminal([*RUN, *SHORT, "--no-browser"], env, tmp_path) as terminal:
        terminal.expect("see it at ")

        assert terminal.wait() == 0
        assert not opened.exists()


@pytest.mark.parametrize("view_only", [True, False])
def test_the_view_only_link_is_printed_on_request(view_only: bool) -> None:
    lines: list[str] = []
    at = PageAddress(port=0, view_only=view_only)
    with PageServer.start(Session(title="t", kind="graph"), at=at) as page:
        announce_page(page, at, lines.append, opens_browser=False)

        assert lines == [f"see it at {page.url}", *([f"view-only link: {page.view_url}"] if view_only else [])]


def test_no_browser_opens_without_a_terminal(env: Mapping[str, str], opened: Path) -> None:
    done = subprocess.run([*RUN, *SHORT], env=dict(env), capture_output=True, text=True, timeout=100)

    assert (done.returncode, "see it at http://" in done.stderr, opened.exists()) == (0, True, False)


@pytest.mark.skipif(sys.platform != "linux", reason="DISPLAY and WAYLAND_DISPLAY are Linux' signs of a display")
def test_without_a_display_only_browser_variables_count() -> None:
    assert not has_browser({})
    assert not has_browser({"SSH_CONNECTION": "1 2 3 4"})
    assert has_browser({"BROWSER": "/opt/code/browser.sh"})
