"""The page opens by itself where a person sees the terminal and has a browser."""

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest
from tests.graphs import until
from tests.shell.terminal import Terminal

from trundle.bringup.browser import has_browser

RUN = (sys.executable, "-m", "trundle", "run", "model://rp2w", "--no-ros", "--no-sensors", "--port", "0")
SHORT = ("--duration", "0.2", "--speed", "max")


@pytest.fixture
def opened(tmp_path: Path) -> Path:
    """File of the URLs that the browser was asked to open, one per line."""
    browser = tmp_path / "browser"
    browser.write_text(f'#!/bin/sh\necho "$1" >> {tmp_path}/opened\n')
    browser.chmod(0o755)
    return tmp_path / "opened"


@pytest.fixture
def env(opened: Path) -> Mapping[str, str]:
    return {**os.environ, "BROWSER": str(opened.with_name("browser"))}


def test_a_person_at_a_terminal_sees_the_page_at_once(env: Mapping[str, str], opened: Path, tmp_path: Path) -> None:
    with Terminal(RUN, env, tmp_path) as terminal:
        terminal.expect("see it at ")
        url = re.search(r"http://\S+", terminal.expect("\n"))
        until(lambda: opened.exists() and opened.read_text().endswith("\n"))

        assert url is not None
        assert opened.read_text().split() == [url[0]]

        terminal.keys("\x03")
        assert terminal.wait() == 130


def test_a_person_may_want_the_url_only(env: Mapping[str, str], opened: Path, tmp_path: Path) -> None:
    with Terminal([*RUN, *SHORT, "--no-browser"], env, tmp_path) as terminal:
        terminal.expect("see it at ")

        assert terminal.wait() == 0
        assert not opened.exists()


def test_a_script_opens_nothing(env: Mapping[str, str], opened: Path) -> None:
    done = subprocess.run([*RUN, *SHORT], env=dict(env), capture_output=True, text=True, timeout=100)

    assert (done.returncode, "see it at http://" in done.stderr, opened.exists()) == (0, True, False)


@pytest.mark.skipif(sys.platform != "linux", reason="DISPLAY and WAYLAND_DISPLAY are Linux' signs of a display")
def test_without_a_display_only_the_users_own_choice_counts() -> None:
    assert not has_browser({})
    assert not has_browser({"SSH_CONNECTION": "1 2 3 4"})
    assert has_browser({"BROWSER": "/opt/code/browser.sh"})
