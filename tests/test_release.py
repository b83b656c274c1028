"""Statements about a release agree in all places."""

import re
from pathlib import Path

import pytest

import trundle

ROOT = Path(__file__).parents[1]
CITATION = ROOT / "CITATION.cff"


@pytest.mark.skipif(not CITATION.is_file(), reason="CITATION.cff is not part of the sdist")
def test_the_citation_names_this_version() -> None:
    (version,) = re.findall(r"^version: (.+)$", CITATION.read_text(), re.MULTILINE)

    assert version == trundle.__version__


@pytest.mark.skipif(not (ROOT / ".dockerignore").is_file(), reason="the sdist has no hidden files")
def test_the_container_has_all_that_the_build_reads() -> None:
    """.dockerignore passes the files that CMake and the package's metadata name."""
    let_through = {line[1:] for line in (ROOT / ".dockerignore").read_text().splitlines() if line.startswith("!")}

    assert {"src", "cpp", "web", "examples", "CMakeLists.txt", "pyproject.toml", "README.md", "LICENSE"} <= let_through
