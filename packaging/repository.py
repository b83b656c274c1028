"""Writes the address of the repository to the files that name it; once, when the repository has one.

    python packaging/repository.py https://github.com/OWNER/trundle

`pyproject.toml` gets [project.urls], which the index shows and by which the README's links become absolute there;
`mkdocs.yml` the link at the top of the site, and `CITATION.cff` the repository of the citation.
"""

import re
import sys
from pathlib import Path

_ADDRESS = re.compile(r"https://[\w.-]+(/[\w.-]+)+")
_URLS = re.compile(r"\[project\.urls\]\n(?:[^\[\n].*\n)*\n")


def write_repository(root: Path, address: str) -> None:
    """Write the address to the files below `root`, in place of an earlier one."""
    address = address.removesuffix("/")
    if not _ADDRESS.fullmatch(address):
        sys.exit(f"{address!r} is no address such as https://github.com/OWNER/trundle")
    urls = (
        f'[project.urls]\nRepository = "{address}"\nIssues = "{address}/issues"\n'
        f'Changelog = "{address}/blob/main/CHANGELOG.md"\n\n'
    )
    _rewrite(root / "pyproject.toml", _URLS, urls, before="[project.optional-dependencies]\n")
    line = re.compile(r"^repo_url: .*\n", re.MULTILINE)
    _rewrite(root / "mkdocs.yml", line, f"repo_url: {address}\n", before="docs_dir:")
    line = re.compile(r"^repository-code: .*\n", re.MULTILINE)
    _rewrite(root / "CITATION.cff", line, f"repository-code: {address}\n", before="license:")


def _rewrite(file: Path, earlier: re.Pattern[str], text: str, *, before: str) -> None:
    content = earlier.sub("", file.read_text(encoding="utf-8"), count=1)
    first, marker, rest = content.partition(before)
    assert marker, f"{file} has no {before!r}"
    file.write_text(f"{first}{text}{marker}{rest}", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write_repository(Path(__file__).parents[1], sys.argv[1])
