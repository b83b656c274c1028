"""New packages: the same elements and commands as those of Debian's catkin_create_pkg, where it is installed."""

import re
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest

from trundle.base.diagnostics import UsageError
from trundle.robots.packages import run_dependencies
from trundle.ros.catkin import NewPackage, create_package, package_warnings

_ORIGINAL = Path("/usr/bin/catkin_create_pkg")


def _manifest(path: Path) -> list[tuple[str, str]]:
    root = ElementTree.parse(path).getroot()
    inside = [(child.tag, (child.text or "").strip()) for child in root]
    return sorted([*inside, *((f"export/{child.tag}", "") for child in root.find("export") or ())])


def _commands(path: Path) -> list[str]:
    text = re.sub(r"#[^\n]*", "", path.read_text())
    return [re.sub(r"\s+", " ", found).strip() for found in re.findall(r"\w+\s*\([^)]*\)", text)]


@pytest.mark.parametrize(
    ("words", "package"),
    [
        (["plain"], NewPackage(name="plain")),
        (
            ["robot", "rospy", "std_msgs", "roscpp"],
            NewPackage(name="robot", dependencies=("rospy", "std_msgs", "roscpp")),
        ),
        (["py_only", "rospy"], NewPackage(name="py_only", dependencies=("rospy",))),
        (
            ["msgs", "message_generation", "message_runtime", "std_msgs"],
            NewPackage(name="msgs", dependencies=("message_generation", "message_runtime", "std_msgs")),
        ),
        (
            ["full", "rospy", "-D", "Drives and turns", "-l", "MIT", "-a", "Ann", "-m", "Bob", "-V", "1.2.3"],
            NewPackage(
                name="full",
                dependencies=("rospy",),
                description="Drives and turns",
                licences=("MIT",),
                authors=("Ann",),
                maintainers=("Bob",),
                version="1.2.3",
            ),
        ),
        (["all", "robot", "--meta"], NewPackage(name="all", dependencies=("robot",), is_metapackage=True)),
    ],
    ids=lambda value: value[0] if isinstance(value, list) else "",
)
def test_files_and_lines_are_the_originals(
    words: list[str], package: NewPackage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not _ORIGINAL.exists():
        pytest.skip("Debian's catkin is not installed (make system)")
    theirs, ours = tmp_path / "theirs", tmp_path / "ours"
    theirs.mkdir()
    monkeypatch.setenv("USER", "someone")
    printed = subprocess.run([_ORIGINAL, *words], cwd=theirs, capture_output=True, text=True, check=True).stdout

    lines = list(create_package(ours, package))

    assert lines == printed.replace(str(theirs), str(ours)).splitlines()
    names = sorted(path.relative_to(theirs) for path in theirs.rglob("*"))
    assert sorted(path.relative_to(ours) for path in ours.rglob("*")) == names
    folder = package.name
    manifests = [
        [pair for pair in _manifest(each / folder / "package.xml") if pair[0] != "maintainer" or package.maintainers]
        for each in (ours, theirs)
    ]
    assert manifests[0] == manifests[1]
    # The original's metapackages ask for an older CMake, and its include folder is a comment.
    wanted = [each.replace("VERSION 2.8.3", "VERSION 3.0.2") for each in _commands(theirs / folder / "CMakeLists.txt")]
    found = [each.replace("( include ", "( ") for each in _commands(ours / folder / "CMakeLists.txt")]
    assert found == wanted


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot/CMakeLists.txt").write_text("mine")

    with pytest.raises(UsageError, match=r"File exists: .*robot/CMakeLists\.txt"):
        list(create_package(tmp_path, NewPackage(name="robot")))

    assert (tmp_path / "robot/CMakeLists.txt").read_text() == "mine"
    assert not (tmp_path / "robot/package.xml").exists()


def test_trundle_reads_what_is_written(tmp_path: Path) -> None:
    list(create_package(tmp_path, NewPackage(name="robot", dependencies=("rospy", "std_msgs"))))

    assert run_dependencies(tmp_path / "robot") == ["rospy", "std_msgs"]


def test_names_and_halves_of_message_packages_are_warned_of() -> None:
    warnings = list(package_warnings(NewPackage(name="Robot", dependencies=("message_generation",))))

    assert [re.split(r" does not| should", line)[0] for line in warnings] == [
        'Package name "Robot"',
        "Packages with messages or services",
    ]
