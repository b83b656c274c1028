"""The documentation's site builds without warnings, loads nothing from other servers, and fits every window."""

import http.server
import re
import subprocess
import sys
import threading
from collections.abc import Iterator
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
_FAULTS = """() => {
  const CODE_PADDING = 8;  // of code that breaks, beyond the line's end [px]
  const found = [], shown = (element) => element.getClientRects().length > 0;
  const say = (what, element) => found.push(`${what}: ${element.textContent.trim().slice(0, 60)}`);
  const { scrollWidth } = document.documentElement, content = document.querySelector(".md-content");
  if (scrollWidth > innerWidth) found.push(`the page is ${scrollWidth} px wide`);
  for (const name of content.querySelectorAll("code.name"))
    if (name.getClientRects().length > 1) say("a name is broken", name);
  for (const cell of content.querySelectorAll("td, th, h1, h2, h3, h4, h5, p, li"))
    if (shown(cell) && cell.scrollWidth > cell.clientWidth + CODE_PADDING && cell.clientWidth > 0
        && getComputedStyle(cell).display !== "inline") say("too wide for its place", cell);
  for (const picture of content.querySelectorAll("img, video, svg"))
    if (picture.getBoundingClientRect().right > innerWidth + 1) found.push(`a picture is cut: ${picture.src}`);
  return found;
}"""
"""What is cut or broken on a page, in sentences."""


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
        return (site / f"reference/{name}.html").read_text().replace("<wbr>", "")  # in paths

    assert "libgazebo_ros_diff_drive.so" in page("plugins")
    assert "topic_tools/throttle" in page("nodes")
    assert "trundle topic echo" in page("cli")
    assert re.search(r"friction/ode/mu2</code>.*>read</td>", page("sdf"))
    assert "joint_state_controller/JointStateController" in page("controllers")
    assert "launch-prefix" in page("roslaunch")
    assert "xacro:insert_block" in page("xacro")
    assert "leaves no freedom; rigid" in page("diagnostics")
    assert 'id="trundle.Simulation.run"' in page("python")


class _Quiet(http.server.SimpleHTTPRequestHandler):
    """Serves files without a line for each."""

    def log_message(self, format: str, *args: object) -> None: ...


@pytest.fixture(scope="module")
def origin(site: Path) -> Iterator[str]:
    """Origin of a server of the site."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(site)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


@pytest.mark.browser
def test_the_site_loads_nothing_from_other_hosts(origin: str, chromium: Any) -> None:
    page = chromium.new_page()
    requests: list[str] = []
    failed: list[str] = []
    page.on("request", lambda request: requests.append(request.url))
    page.on("response", lambda response: failed.append(response.url) if response.status >= 400 else None)
    for name in ("index", "start", "reference/sdf", "howto/see"):
        page.goto(f"{origin}/{name}.html", wait_until="networkidle")
    page.close()
    assert len(requests) > 10
    assert [url for url in requests if not url.startswith((origin, "data:", "blob:"))] == []
    assert failed == []


@pytest.mark.browser
@pytest.mark.parametrize("width", [1440, 390])
def test_nothing_is_cut_on_any_page(site: Path, origin: str, chromium: Any, width: int) -> None:
    """Neither the page nor a cell of a table scrolls sideways, and no line breaks within a name."""
    page = chromium.new_page(viewport={"width": width, "height": 900})
    page.set_default_timeout(300_000)
    faults: list[str] = []
    pages = sorted(file.relative_to(site).as_posix() for file in site.rglob("*.html"))
    for name in pages:
        if name != "404.html":
            page.goto(f"{origin}/{name}", wait_until="load")
            faults += [f"{name}: {fault}" for fault in page.evaluate(_FAULTS)]
    page.close()

    assert len(pages) > 80
    assert faults == []
