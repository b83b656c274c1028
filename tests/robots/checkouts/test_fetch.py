"""Packages of a git server on this machine, by an index of the published form."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.git_server import GitServer, git_server, manifest

from trundle.base.diagnostics import UsageError
from trundle.robots.checkouts import Fetcher
from trundle.robots.packages import Packages
from trundle.robots.repositories import Checkout, Entry, Index


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[GitServer]:
    with git_server(tmp_path_factory.mktemp("served")) as server:
        server.add(
            "me/arm",
            {
                "noetic-devel": {"arm_description/package.xml": manifest("arm_description", "hand", "roscpp")},
                "main": {"arm_description/package.xml": manifest("arm_description", build="ament_cmake")},
            },
        )
        needs = ("std_msgs", "python3-opencv", "libusb-1.0-dev")
        server.add("me/hand", {"main": {"package.xml": manifest("hand", *needs), "urdf/hand.urdf": "<robot/>"}})
        yield server


def entry(url: str, branches: dict[str, str], *packages: str) -> Entry:
    return Entry(url, branches, packages)


@pytest.fixture
def fetcher(server: GitServer, tmp_path: Path, log: list[str]) -> Fetcher:
    return make(
        [
            entry(f"{server.address}/me/arm", {"noetic": "noetic-devel"}, "arm_description"),
            entry(f"{server.address}/me/hand", {}, "hand"),
            entry(f"{server.address}/me/gone", {"noetic": "main"}, "gone"),
        ],
        tmp_path,
        log,
    )


@pytest.fixture
def log() -> list[str]:
    return []


def make(entries: list[Entry], tmp_path: Path, log: list[str]) -> Fetcher:
    return Fetcher(index=Index(entries), distro="noetic", folder=tmp_path / "got", environment={}, log=log.append)


def test_a_package_comes_with_those_it_needs(fetcher: Fetcher, tmp_path: Path, log: list[str]) -> None:
    result = fetcher.fetch(["arm_description"])

    assert result.errors == []
    assert result.folders == [tmp_path / "got/me/arm", tmp_path / "got/me/hand"]
    assert result.built_in == ["roscpp", "std_msgs"]
    assert result.python_libraries == ["opencv-python"]
    assert result.unknown == ["libusb-1.0-dev"]
    assert "me/arm: noetic-devel, commit " in log[0]
    assert ", licence BSD, " in log[0]
    fetched = Packages({"ROS_PACKAGE_PATH": str(tmp_path / "got")}, start=tmp_path)
    assert fetched.find_package("hand") == tmp_path / "got/me/hand"


def test_fetched_packages_are_found_without_any_path(fetcher: Fetcher, tmp_path: Path) -> None:
    environment = {"XDG_DATA_HOME": str(tmp_path)}
    fetcher.fetch(["hand"])
    (tmp_path / "trundle").mkdir()
    (tmp_path / "got").rename(tmp_path / "trundle/packages")

    assert Packages(environment, start=tmp_path / "elsewhere").find_package("hand") == (
        tmp_path / "trundle/packages/me/hand"
    )


def test_a_branch_for_ros_2_is_left_for_the_one_of_ros_1(server: GitServer, tmp_path: Path, log: list[str]) -> None:
    fetcher = make([entry(f"{server.address}/me/arm", {}, "arm_description")], tmp_path, log)

    result = fetcher.fetch(["arm_description"])

    assert result.errors == []
    assert log[0].endswith("me/arm: its default branch is for ROS 2")
    assert "me/arm: noetic-devel, commit" in log[1]


def test_the_nearest_branch_replaces_a_missing_one(server: GitServer, tmp_path: Path, log: list[str]) -> None:
    fetcher = make([entry(f"{server.address}/me/arm", {"kinetic": "kinetic-devel"}, "arm_description")], tmp_path, log)

    assert fetcher.fetch(["arm_description"]).errors == []
    assert "me/arm: noetic-devel, commit" in log[0]


def test_a_repository_that_fails_stops_no_other(fetcher: Fetcher, tmp_path: Path) -> None:
    result = fetcher.fetch(["gone", "hand"])

    assert result.folders == [tmp_path / "got/me/hand"]
    assert len(result.errors) == 1
    assert result.errors[0].startswith("gone: git://127.0.0.1")
    assert "was not fetched: git fetch failed: " in result.errors[0]
    assert sorted(path.name for path in (tmp_path / "got/me").iterdir()) == ["hand"], "nothing half-fetched stays"


def test_a_folder_that_is_there_is_not_touched(fetcher: Fetcher, server: GitServer, tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    with pytest.raises(UsageError, match="is there already"):
        fetcher.fetch_repository(Checkout(f"{server.address}/me/hand", "", ""), tmp_path / "mine")


def test_nothing_of_a_repository_is_run(tmp_path: Path, server: GitServer, log: list[str]) -> None:
    """Hooks, submodules, filters and links that lead outside have no effect."""
    ran = tmp_path / "ran"
    secret = tmp_path / "secret"
    secret.write_text("mine")
    files = {
        "package.xml": manifest("evil"),
        ".gitmodules": f'[submodule "a"]\n\tpath = a\n\turl = file://{secret.parent}\n\tupdate = !touch {ran}\n',
        ".gitattributes": "*.dae filter=evil\n",
        "a.dae": "mesh",
        "hooks/post-checkout": f"#!/bin/sh\ntouch {ran}\n",
        "setup.py": f"open({str(ran)!r}, 'w')\n",
    }
    url = server.add("you/evil", {"main": files}, {"meshes": str(tmp_path), "secret": str(secret), "own.dae": "a.dae"})
    fetcher = make([entry(url, {}, "evil")], tmp_path, log)

    result = fetcher.fetch(["evil"])

    folder = tmp_path / "got/you/evil"
    assert result.folders == [folder]
    assert not ran.exists()
    assert not (folder / "meshes").is_symlink()
    assert not (folder / "secret").is_symlink()
    assert (folder / "own.dae").read_text() == "mesh"
    assert secret.read_text() == "mine"
    assert "  removed the link secret, which leads out of the repository" in log
    assert "  its submodules are not fetched" in log
