"""README of the package's metadata: its links are absolute, as an index has no files beside it."""

import re
import tomllib
from pathlib import Path

_ROOT = Path(__file__).parents[1]
_LINK = re.compile(r"(!?)\[([^\]]*)\]\((?!https?://|#)([^)]+)\)")
_HTML = re.compile(r'(<img\b[^>]*\bsrc=")(?!https?://)([^"]+)"')


def dynamic_metadata(*_: object) -> dict[str, str]:
    """`readme` of [project]; scikit-build-core asks for it while it builds."""
    project = tomllib.loads((_ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    text = (_ROOT / "README.md").read_text(encoding="utf-8")
    return {"content-type": "text/markdown", "text": absolute_links(text, project.get("urls", {}).get("Repository"))}


def absolute_links(text: str, repository: str | None) -> str:
    """Return Markdown with links into the repository; without the repository's address as it is."""
    if repository is None:
        return text
    raw, blob = f"{repository}/raw/main", f"{repository}/blob/main"
    text = _HTML.sub(lambda found: f'{found[1]}{raw}/{found[2]}"', text)
    return _LINK.sub(lambda found: f"{found[1]}[{found[2]}]({raw if found[1] else blob}/{found[3]})", text)
