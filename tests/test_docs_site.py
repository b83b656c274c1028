"""The documentation's site builds without warnings and loads nothing from other servers."""

import http.server
import re
import subprocess
import sys
import threading
from functools import partial
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import pytest
from tests.docs_blocks import ROOT

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not (ROOT / "mkdocs.yml").is_file(), reason="the site is not part of the sdist"),
]
_LOADED = re.compile(
    r"<(?:script|img|video|source|iframe|embed|audio)\b[^>]*?\ssrc=[\"']?([^\"'\s>]+)"
    r"|<link\b(?=[^>]*?rel=[\"']?(?:stylesheet|icon|preload|preconnect|prefetch|manifest))[^>]*?\shref=[\"']?([^\"'\s>]+)"
    r"|url\(\s*[\"']?([^\"')\s]+)|@import\s+[\"']([^\"']+)"
)
"""URLs in elements that a browser loads automatically."""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site, built like by `make docs`."""
    pytest.importorskip("material", reason="Material for MkDocs is not installed")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-W", "ignore", "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)]
    process = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert process.returncode == 0, process.stderr
    return folder


def test_pages_link_only_existing_local_files(site: Path) -> None:
    pages = {file: file.read_text() for kind in ("html", "css") for file in site.rglob(f"*.{kind}")}
    loaded = [(page, next(filter(None, groups))) for page, text in pages.items() for groups in _LOADED.findall(text)]
    assert len(pages) > 40
    assert len(loaded) > 100

    foreign = {url for _, url in loaded if urlsplit(url).netloc}
    assert foreign == set()
    local = [(page, urlsplit(url).path) for page, url in loaded if not url.startswith(("data:", "#"))]
    missing = [(page.name, url) for page, url in local if not (page.parent / unquote(url).lstrip("/")).exists()]
    assert missing == []


def test_references_have_generated_content(site: Path) -> None:
    def page(name: str) -> str:
        return (site / f"reference/{name}.html").read_text()

    assert "libgazebo_ros_diff_drive.so" in page("plugins")
    assert "topic_tools/throttle" in page("nodes")
    assert "trundle topic echo" in page("cli")
    assert re.search(r"friction/ode/mu2</code>.*>read</td>", page("sdf"))
    assert "joint_state_controller/JointStateController" in page("controllers")
    assert "launch-prefix" in page("roslaunch")
    assert "xacro:insert_block" in page("xacro")
    assert "leaves no freedom; rigid" in page("diagnostics")
    assert 'id="trundle.Simulation.run"' in page("python")


@pytest.mark.browser
def test_the_site_loads_nothing_from_other_hosts(site: Path, chromium: Any) -> None:
    handler = partial(http.server.SimpleHTTPRequestHandler, directory=str(site))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        origin = f"http://127.0.0.1:{server.server_port}"
        page = chromium.new_page()
        requests: list[str] = []
        failed: list[str] = []
        page.on("request", lambda request: requests.append(request.url))
        page.on("response", lambda response: failed.append(response.url) if response.status >= 400 else None)
        for name in ("index", "start", "reference/sdf", "howto/see"):
            page.goto(f"{origin}/{name}.html", wait_until="networkidle")
        assert len(requests) > 10
        assert [url for url in requests if not url.startswith((origin, "data:", "blob:"))] == []
        assert failed == []
    finally:
        server.shutdown()
        server.server_close()
