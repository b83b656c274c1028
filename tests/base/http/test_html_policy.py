"""HTML files that Trundle writes, opened in a browser with hostile names and injected markup."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.replay import test_replay_page as replay
from tests.studies.dataset import test_formats as dataset
from tests.studies.sweep import test_sweep as sweep

from trundle.base.http.html_policy import policy_of_viewer

INJECTED = (
    '<img src="x" onerror="window.ran = 1"><script>window.ran = 1</script>'
    '<script src="http://evil.example/x.js"></script><link rel="stylesheet" href="http://evil.example/x.css">'
    '<iframe src="http://evil.example/"></iframe><svg onload="window.ran = 1"></svg>'
    '<a id="link" href="javascript:window.ran = 1">link</a><object data="http://evil.example/"></object>'
)
HOSTILE = "a<img src=x onerror=window.ran=1>\"'&\u202e\u200b"
"""File name with markup, quotes, a direction override and a zero-width space."""


def _trundle(*words: str, folder: Path, code: int = 0) -> str:
    process = subprocess.run([sys.executable, "-m", "trundle", *words], cwd=folder, capture_output=True, text=True)
    assert process.returncode == code, process.stderr
    return process.stdout


def _replay(folder: Path) -> Path:
    (folder / "w.sdf").write_text(replay.BOUNCE)
    options = ("--headless", "--no-ros", "--duration", "0.5", "--speed", "max", "--record", f"{HOSTILE}.log")
    _trundle("run", "w.sdf", *options, folder=folder)
    _trundle("convert", f"{HOSTILE}.log", "--to", "html", "-o", "run.html", folder=folder)
    return folder / "run.html"


def _report(folder: Path) -> Path:
    pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
    (folder / "box.sdf").write_text(sweep.WORLD)
    (folder / "box.py").write_text("def mass(sim):\n    return sim['box'].link('link').link.inertial.mass\n")
    (folder / f"{HOSTILE}.yaml").write_text(sweep.PLAN.replace("samples: 8", "samples: 4"))
    _trundle("sweep", f"{HOSTILE}.yaml", "--workers", "1", folder=folder, code=1)  # three rows fail on purpose
    return folder / _trundle("sweep", "report", f"{HOSTILE}.yaml", folder=folder).strip()


def _contact_sheet(folder: Path) -> Path:
    pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
    (folder / "world.sdf").write_text(dataset.WORLD)
    (folder / "car.sdf").write_text(dataset.MODEL.format(shape="<box><size>0.8 0.4 0.5</size></box>"))
    (folder / "ball.sdf").write_text(dataset.MODEL.format(shape="<sphere><radius>0.2</radius></sphere>"))
    (folder / f"{HOSTILE}.yaml").write_text(dataset.PLAN)
    _trundle("dataset", f"{HOSTILE}.yaml", folder=folder)
    (file,) = folder.rglob("contact_sheet.html")
    return file


@pytest.mark.slow
@needs_client
@pytest.mark.skipif(os.name != "posix", reason='names of files have no <, > and " elsewhere')
@pytest.mark.parametrize("write", [_replay, _report, _contact_sheet])
def test_html_files_load_nothing_and_run_only_their_own_script(
    chromium: Any, tmp_path: Path, write: Callable[[Path], Path]
) -> None:
    """The file violates no rule of its policy; with injected elements, it runs and loads none of them."""
    file = write(tmp_path)

    violations, requested = _open(chromium, file)
    assert violations == []
    assert [url for url in requested if not url.startswith(("blob:", "data:"))] == [file.as_uri()]

    html = file.read_text(encoding="utf-8")
    assert html.count("<body>") == 1
    hostile = tmp_path / "hostile.html"
    hostile.write_text(html.replace("<body>", f"<body>{INJECTED}"), encoding="utf-8")
    violations, _ = _open(chromium, hostile)
    assert len(violations) >= 4


def test_injected_scripts_run_without_the_policy(chromium: Any, tmp_path: Path) -> None:
    """With another script's policy they do not."""
    for policy, ran in (("", True), (policy_of_viewer("other()"), False)):
        (tmp_path / "bare.html").write_text(f"<head>{policy}</head><body>{INJECTED}</body>")
        _open(chromium, tmp_path / "bare.html", ran=ran)


def _open(chromium: Any, file: Path, *, ran: bool = False) -> tuple[list[str], list[str]]:
    """Open a file; return violations of its policy, and the requested URLs."""
    violations: list[str] = []
    requested: list[str] = []
    external: list[str] = []
    context = chromium.new_context()
    page = context.new_page()
    page.route("http://**", lambda route: external.append(route.request.url) or route.abort())
    page.on("console", lambda message: violations.append(message.text) if "Security Policy" in message.text else None)
    page.on("request", lambda request: requested.append(request.url))
    page.goto(file.as_uri())
    page.wait_for_timeout(500)
    if page.locator("#link").count():
        page.locator("#link").evaluate("link => link.click()")
        page.wait_for_timeout(200)
    assert page.evaluate("window.ran === 1") is ran
    assert bool(external) is ran, "requests that leave the browser"
    context.close()
    return violations, requested
