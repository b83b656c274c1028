"""Version, packaging and release files are consistent."""

import importlib.metadata
import re
import runpy
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from packaging.specifiers import SpecifierSet

import trundle
from trundle.base.extras import rospy_requirements

ROOT = Path(__file__).parents[1]
CITATION = ROOT / "CITATION.cff"
THIRD_PARTY = ("mujoco-warp", "cmake", "ninja", "cmeel-boost", "jupyterlab")
"""Other projects' packages in the documentation."""


@pytest.mark.skipif(not CITATION.is_file(), reason="CITATION.cff is not part of the sdist")
def test_the_citation_and_trundle_rospy_have_the_current_version() -> None:
    (version,) = re.findall(r"^version: (.+)$", CITATION.read_text(), re.MULTILINE)
    rospy = tomllib.loads((ROOT / "packaging/trundle-rospy/pyproject.toml").read_text())["project"]

    assert version == rospy["version"] == trundle.__version__
    assert f"trundle=={version}" in rospy["dependencies"]


@pytest.mark.skipif(not CITATION.is_file(), reason="CITATION.cff is not part of the sdist")
def test_the_repositorys_address_is_written_once_to_all_files(tmp_path: Path) -> None:
    names = ("pyproject.toml", "mkdocs.yml", "CITATION.cff")
    for name in names:
        shutil.copy(ROOT / name, tmp_path)
    write = runpy.run_path(str(ROOT / "packaging/repository.py"))["write_repository"]

    write(tmp_path, "https://example.org/first/trundle")
    write(tmp_path, "https://example.org/me/trundle/")

    texts = {name: (tmp_path / name).read_text() for name in names}
    project = tomllib.loads(texts["pyproject.toml"])["project"]
    assert project["urls"]["Repository"] == "https://example.org/me/trundle"
    assert project["urls"]["Issues"] == "https://example.org/me/trundle/issues"
    assert project.keys() - tomllib.loads((ROOT / "pyproject.toml").read_text())["project"].keys() <= {"urls"}
    assert texts["mkdocs.yml"].count("\nrepo_url: https://example.org/me/trundle\n") == 1
    assert texts["CITATION.cff"].count("\nrepository-code: https://example.org/me/trundle\n") == 1
    assert "example.org/first" not in "".join(texts.values())
    with pytest.raises(SystemExit, match="is no address"):
        write(tmp_path, "trundle")


def test_links_of_the_readme_are_absolute_on_an_index() -> None:
    absolute_links = runpy.run_path(str(ROOT / "cpp/readme.py"))["absolute_links"]
    readme = (ROOT / "README.md").read_text()

    text = absolute_links(readme, "https://example.org/me/trundle")

    targets = re.findall(r"\]\(([^)]+)\)", text) + re.findall(r'src="([^"]+)"', text)
    assert len(targets) > 20
    assert [target for target in targets if not target.startswith("https://")] == []
    assert "![The RP2W" in text
    assert "](https://example.org/me/trundle/raw/main/docs/page.webp)" in text
    assert "](https://example.org/me/trundle/blob/main/docs/start.md)" in text
    assert absolute_links(readme, None) == readme


@pytest.mark.skipif(not (ROOT / ".dockerignore").is_file(), reason="the sdist has no hidden files")
def test_the_container_has_all_files_of_the_build() -> None:
    """.dockerignore includes the files named in CMake and in the package's metadata."""
    included = {line[1:] for line in (ROOT / ".dockerignore").read_text().splitlines() if line.startswith("!")}

    assert {"src", "cpp", "web", "examples", "CMakeLists.txt", "pyproject.toml", "README.md", "LICENSE"} <= included


def test_pinned_packages_install_on_the_python_of_debian_12() -> None:
    """It is 3.11.2; a pin that needs a later one ends `make` there."""
    pinned = {line.partition("==")[0] for line in (ROOT / "constraints.txt").read_text().splitlines()}
    needs = {
        package.name: package.metadata["Requires-Python"]
        for package in importlib.metadata.distributions()
        if package.name.lower().replace("_", "-") in pinned and package.metadata["Requires-Python"]
    }
    assert len(needs) > 50
    assert {name: python for name, python in needs.items() if "3.11.2" not in SpecifierSet(python)} == {}


def _pip_lines(*folders: str) -> list[tuple[str, list[str]]]:
    """Return each `pip install …` of the documentation with its requirements."""
    files = [ROOT / "README.md", ROOT / "packaging/trundle-rospy/README.md"]
    files += [path for folder in folders for path in (ROOT / folder).rglob("*.md") if "decisions" not in path.parts]
    lines = [line for path in files for line in re.findall(r"pip install ([^`\n]+)", path.read_text())]
    return [(line, [word for word in shlex.split(line, comments=True) if not word.startswith("-")]) for line in lines]


@pytest.mark.skipif(not (ROOT / "packaging").is_dir(), reason="the documentation's paths are those of a checkout")
def test_pip_install_lines_of_the_documentation_name_our_projects_and_extras() -> None:
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    lines = _pip_lines("docs")
    assert len(lines) > 5
    for line, words in lines:
        for word in words:
            name, _, extra = word.rstrip("]").partition("[")
            assert name in ("trundle", "trundle-rospy", *THIRD_PARTY), line
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
