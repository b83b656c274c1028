"""Version, packaging and release files are consistent."""

import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import trundle
from trundle.base.extras import rospy_requirements

ROOT = Path(__file__).parents[1]
CITATION = ROOT / "CITATION.cff"
THIRD_PARTY = ("mujoco-warp", "cmake", "ninja", "cmeel-boost")
"""Other projects' packages in the documentation."""


@pytest.mark.skipif(not CITATION.is_file(), reason="CITATION.cff is not part of the sdist")
def test_the_citation_has_the_current_version() -> None:
    (version,) = re.findall(r"^version: (.+)$", CITATION.read_text(), re.MULTILINE)

    assert version == trundle.__version__


@pytest.mark.skipif(not (ROOT / ".dockerignore").is_file(), reason="the sdist has no hidden files")
def test_the_container_has_all_files_of_the_build() -> None:
    """.dockerignore includes the files named in CMake and in the package's metadata."""
    included = {line[1:] for line in (ROOT / ".dockerignore").read_text().splitlines() if line.startswith("!")}

    assert {"src", "cpp", "web", "examples", "CMakeLists.txt", "pyproject.toml", "README.md", "LICENSE"} <= included


def _pip_lines(*folders: str) -> list[tuple[str, list[str]]]:
    """Return each `pip install …` of the documentation with its requirements."""
    files = [ROOT / "README.md", ROOT / "packaging/trundle-rospy/README.md"]
    files += [path for folder in folders for path in (ROOT / folder).rglob("*.md") if "decisions" not in path.parts]
    lines = [line for path in files for line in re.findall(r"pip install ([^`\n]+)", path.read_text())]
    return [(line, [word for word in shlex.split(line, comments=True) if not word.startswith("-")]) for line in lines]


@pytest.mark.skipif(not (ROOT / "packaging").is_dir(), reason="the documentation's paths are those of a checkout")
def test_pip_install_lines_of_the_documentation_name_existing_folders() -> None:
    """Before the first release, neither trundle nor trundle-rospy is on an index."""
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    lines = _pip_lines("docs")
    assert len(lines) > 5
    for line, words in lines:
        for word in words:
            folder, _, extra = word.rstrip("]").partition("[")
            if folder in THIRD_PARTY:
                continue
            assert (ROOT / folder / "pyproject.toml").is_file(), line
            assert not extra or extra in extras, line


@pytest.mark.skipif(not (ROOT / "packaging").is_dir(), reason="the advice's path is that of a checkout")
def test_requirements_for_another_python_are_in_this_checkout() -> None:
    assert rospy_requirements() == shlex.join([str(ROOT), str(ROOT / "packaging/trundle-rospy")])


def test_extras_named_in_messages_exist() -> None:
    """`pip install 'trundle[x]'` installs the extra's requirements for the installed Trundle."""
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    named = [
        extra for path in (ROOT / "src").rglob("*.py") for extra in re.findall(r"trundle\[(\w+)\]", path.read_text())
    ]
    assert named
    assert set(named) <= set(extras)


@pytest.mark.skipif(not (ROOT / ".github").is_dir(), reason="the sdist has no hidden files")
def test_actions_of_ci_are_pinned_by_their_commit() -> None:
    """A tag can be moved to other code; the version in the comment is for readers and dependabot."""
    workflows = sorted((ROOT / ".github/workflows").glob("*.yml"))
    used = [action for file in workflows for action in re.findall(r"uses: (.+)", file.read_text())]

    assert used
    assert [action for action in used if not re.match(r"[\w./-]+@[0-9a-f]{40}  # v\d+\.\d+\.\d+", action)] == []


@pytest.mark.skipif(not (ROOT / "changelog.d").is_dir(), reason="fragments of the changelog are not part of the sdist")
def test_fragments_become_a_section_of_the_changelog(tmp_path: Path) -> None:
    for name in ("pyproject.toml", "CHANGELOG.md"):
        shutil.copy(ROOT / name, tmp_path)
    shutil.copytree(ROOT / "changelog.d", tmp_path / "changelog.d")
    (tmp_path / "changelog.d/+lidar.fixed.md").write_text("A lidar measures.\n")
    command = [sys.executable, "-m", "towncrier", "build", "--yes", "--version", "9.8.7", "--date", "2030-01-02"]

    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)

    text = (tmp_path / "CHANGELOG.md").read_text()
    section = text[text.index("## [9.8.7] - 2030-01-02") : text.index("## [Unreleased]")]
    assert "### Fixed" in section
    assert "- A lidar measures.\n" in section
    assert [path.name for path in (tmp_path / "changelog.d").iterdir()] == ["README.md"]
