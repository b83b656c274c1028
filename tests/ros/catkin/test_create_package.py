"""New packages, compared with those of Debian's catkin_create_pkg where it is installed."""

import re
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest

from trundle.base.diagnostics import UsageError
from trundle.robots.packages import run_dependencies
from trundle.ros.catkin import NewPackage, create_package, package_warnings

_DEBIANS_TOOL = Path("/usr/bin/catkin_create_pkg")


def _manifest(path: Path) -> list[tuple[str, str]]:
    root = ElementTree.parse(path).getroot()
    inside = [(child.tag, (child.text or "").strip()) for child in root]
    return sorted([*inside, *((f"export/{child.tag}", "") for child in root.find("export") or ())])


def _commands(path: Path) -> list[str]:
    text = re.sub(r"#[^\n]*", "", path.read_text())
    return [re.sub(r"\s+", " ", command).strip() for command in re.findall(r"\w+\s*\([^)]*\)", text)]


@pytest.mark.parametrize(
    ("arguments", "package"),
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
def test_files_and_output_match_catkin_create_pkg(
    arguments: list[str], package: NewPackage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not _DEBIANS_TOOL.exists():
        pytest.skip("Debian's catkin is not installed (make system)")
    debians, ours = tmp_path / "debians", tmp_path / "ours"
    debians.mkdir()
    monkeypatch.setenv("USER", "someone")
    output = subprocess.run([_DEBIANS_TOOL, *arguments], cwd=debians, capture_output=True, text=True, check=True).stdout

    lines = list(create_package(ours, package))

    assert lines == output.replace(str(debians), str(ours)).splitlines()
    names = sorted(path.relative_to(debians) for path in debians.rglob("*"))
    assert sorted(path.relative_to(ours) for path in ours.rglob("*")) == names
    folder = package.name
    manifests = [
        [pair for pair in _manifest(parent / folder / "package.xml") if pair[0] != "maintainer" or package.maintainers]
        for parent in (ours, debians)
    ]
    assert manifests[0] == manifests[1]
    # Debian's metapackages require an older CMake, and its include folder is a comment.
    expected = [
        line.replace("VERSION 2.8.3", "VERSION 3.0.2") for line in _commands(debians / folder / "CMakeLists.txt")
    ]
    commands = [line.replace("( include ", "( ") for line in _commands(ours / folder / "CMakeLists.txt")]
    assert commands == expected


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot/CMakeLists.txt").write_text("mine")

    with pytest.raises(UsageError, match=r"File exists: .*robot/CMakeLists\.txt"):
        list(create_package(tmp_path, NewPackage(name="robot")))

    assert (tmp_path / "robot/CMakeLists.txt").read_text() == "mine"
    assert not (tmp_path / "robot/package.xml").exists()


def test_trundle_reads_the_written_manifest(tmp_path: Path) -> None:
    list(create_package(tmp_path, NewPackage(name="robot", dependencies=("rospy", "std_msgs"))))

    assert run_dependencies(tmp_path / "robot") == ["rospy", "std_msgs"]


def test_unusual_names_and_missing_message_packages_are_warned_of() -> None:
    warnings = list(package_warnings(NewPackage(name="Robot", dependencies=("message_generation",))))

    assert [re.split(r" does not| should", line)[0] for line in warnings] == [
        'Package name "Robot"',
        "Packages with messages or services",
    ]
