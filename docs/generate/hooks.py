"""Hooks of MkDocs' build."""

import re
import sys
from collections.abc import Callable
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs"))  # MkDocs loads this file by its path

from generate import (  # noqa: E402
    api,
    catalogs,
    command_line,
    cpp_headers,
    diagnostics,
    elements,
    gallery,
    pictures,
    sensor_settings,
    tags,
)

PAGES: dict[str, Callable[[], str]] = {
    "decisions/index.md": lambda: _decisions(),
    "gallery.md": gallery.page,
    "reference/cli.md": command_line.page,
    "reference/controllers.md": catalogs.controllers_page,
    "reference/diagnostics.md": diagnostics.page,
    "reference/cpp.md": cpp_headers.ros_page,
    "reference/gazebo_cpp.md": cpp_headers.gazebo_page,
    "reference/nodes.md": catalogs.nodes_page,
    "reference/plugins.md": catalogs.plugins_page,
    "reference/python.md": api.page,
    "reference/roslaunch.md": tags.roslaunch_page,
    "reference/sensors.md": sensor_settings.page,
    "reference/sdf.md": lambda: elements.page("sdf"),
    "reference/urdf.md": lambda: elements.page("urdf"),
    "reference/xacro.md": tags.xacro_page,
}
"""Generated pages, without a file below docs/."""
LESSONS = ROOT / "src/trundle/assets/lessons"
"""Lessons of the page, which are also tutorials here."""
_CHECKS = re.compile(r"^```(check|look)\n.*?^```\n\n?", re.MULTILINE | re.DOTALL)
_NAME = re.compile(r"<code>([^\s<]{1,36})</code>")
"""Names that fit a line of a phone, also in a list."""
_PATH = re.compile(r"<code>([^\s<]*/[^\s<]*)</code>")
_TABLE = re.compile(r"<table>(.*?)</table>", re.DOTALL)
ROOT_PAGES = ("ARCHITECTURE.md", "CONTRIBUTING.md", "RELEASING.md", "SECURITY.md")
"""Files next to docs/ that are also pages."""


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the generated pages, the pictures, and the examples that pages link to."""
    for path, text in PAGES.items():
        files.append(File.generated(config, path, content=text()))
    for name in ROOT_PAGES:
        files.append(File.generated(config, name.lower(), content=_root_page(name)))
    for path in sorted(LESSONS.glob("*.md")):
        files.append(File.generated(config, f"tutorials/{path.name}", content=_CHECKS.sub("", path.read_text())))
    for path in sorted((ROOT / "examples").rglob("*")):
        if path.is_file() and path.suffix != ".pyc":
            files.append(File.generated(config, path.relative_to(ROOT).as_posix(), abs_src_path=str(path)))
    folder = ROOT / "out/pictures"
    for name, picture in {**pictures.draw_all(folder), **gallery.draw_all(folder)}.items():
        files.append(File.generated(config, f"pictures/{name}", abs_src_path=str(picture)))
    return files


def on_page_markdown(markdown: str, **_: object) -> str:
    """Change links to the examples, which are next to docs/, to their copies in the site."""
    return re.sub(r"\]\(\.\./((?:\.\./)*examples/)", r"](\1", markdown)


def on_page_content(html: str, **_: object) -> str:
    """Mark names, which a line must not break, and paths, which it may after a slash; give cells their headings."""
    html = _PATH.sub(lambda path: f'<code class="path">{path[1].replace("/", "/<wbr>")}</code>', html)
    return _TABLE.sub(_with_headings, _NAME.sub(r'<code class="name">\1</code>', html))


def _with_headings(found: re.Match[str]) -> str:
    headings = [re.sub(r"<[^>]+>", "", heading) for heading in re.findall(r"<th[^>]*>(.*?)</th>", found[1], re.DOTALL)]

    def row(found_row: re.Match[str]) -> str:
        names = iter(headings)
        return re.sub(r"<td", lambda _: f'<td data-heading="{next(names, "")}"', found_row[0])

    return f'<table class="reference">{re.sub(r"<tr>.*?</tr>", row, found[1], flags=re.DOTALL)}</table>'


def _root_page(name: str) -> str:
    text = (ROOT / name).read_text().replace("](docs/decisions)", "](decisions/index.md)").replace("](docs/", "](")
    return re.sub(r"\]\(([A-Z]+\.md)", lambda link: f"]({link[1].lower()}", text)


def _decisions() -> str:
    pages = sorted((ROOT / "docs/decisions").glob("*.md"))
    titles = [page.read_text().partition("\n")[0].removeprefix("# ") for page in pages]
    links = [f"- [{title}]({page.name})" for title, page in zip(titles, pages, strict=True)]
    return "\n".join(["# Decisions", "", "Decisions that are hard to reverse, and their reasons.", "", *links, ""])
