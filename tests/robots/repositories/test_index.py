"""Index of published packages, and the files that users have of their own."""

from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError
from trundle.robots.repositories import (
    Checkout,
    Entry,
    Index,
    https_address,
    python_library,
    read_index,
    read_repository_list,
    read_table,
    shipped_index,
    write_table,
)

DISTRIBUTION = """
repositories:
  arm:
    release: {packages: [arm_msgs, arm_description], url: https://x.org/arm-release.git}
    source: {type: git, url: https://x.org/arm.git, version: noetic-devel}
  old:
    source: {type: hg, url: https://x.org/old, version: default}
  trap:
    source: {type: git, url: 'ext::sh -c touch% /tmp/x', version: main}
  option:
    source: {type: git, url: https://x.org/option.git, version: --upload-pack=touch}
"""


@pytest.mark.parametrize(
    ("package", "distro", "url", "branch"),
    [
        ("turtlebot3_gazebo", "noetic", "https://github.com/ROBOTIS-GIT/turtlebot3_simulations.git", "noetic-devel"),
        ("turtlebot_gazebo", "noetic", "https://github.com/turtlebot/turtlebot_simulator.git", "indigo"),
        ("gazebo_plugins", "indigo", "https://github.com/ros-simulation/gazebo_ros_pkgs.git", "indigo-devel"),
        ("gazebo_plugins", "melodic", "https://github.com/ros-simulation/gazebo_ros_pkgs.git", "melodic-devel"),
        ("baxter_gazebo", "kinetic", "https://github.com/RethinkRobotics/baxter_simulator.git", ""),
    ],
)
def test_known_packages_have_their_repository(package: str, distro: str, url: str, branch: str) -> None:
    checkout = shipped_index().find(package, distro)
    assert checkout is not None
    assert checkout[:2] == (url, branch)


def test_every_address_and_branch_of_the_index_is_accepted() -> None:
    index = shipped_index()
    for name in index.names():
        checkout = index.find(name, "noetic")
        assert checkout is not None
        assert https_address(checkout.url) == checkout.url


def test_an_unknown_package_is_nowhere() -> None:
    assert shipped_index().find("no_such_package", "noetic") is None


def test_the_nearest_distribution_is_taken() -> None:
    entries = [Entry("https://x.org/a", {"indigo": "i", "kinetic": "k", "noetic": "n"}, ("a",))]
    index = Index(entries)
    assert [index.find("a", distro) for distro in ("jade", "melodic", "hydro")] == [
        Checkout("https://x.org/a", "i", "indigo"),
        Checkout("https://x.org/a", "n", "noetic"),
        Checkout("https://x.org/a", "i", "indigo"),
    ]


def test_a_written_table_is_read_back_unchanged() -> None:
    entries = [Entry("https://x.org/a", {"indigo": "i"}, ("a", "b")), Entry("https://x.org/c", {}, ("c",))]
    assert list(read_table(write_table(entries))) == entries


def test_an_index_of_the_users_is_read(tmp_path: Path) -> None:
    (tmp_path / "noetic").mkdir()
    (tmp_path / "noetic/distribution.yaml").write_text(DISTRIBUTION)
    (tmp_path / "index-v4.yaml").write_text("distributions: {noetic: {distribution: [noetic/distribution.yaml]}}\n")

    for file in ("index-v4.yaml", "noetic/distribution.yaml"):
        index = read_index(str(tmp_path / file), "noetic")
        assert index.find("arm_msgs", "noetic") == Checkout("https://x.org/arm.git", "noetic-devel", "noetic")
        assert index.names() == ["arm_description", "arm_msgs"], "what git could misuse is left out"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[]", "no index"),
        ("a: [", "not YAML"),
        ("distributions: {noetic: {distribution: [../../etc/passwd]}}", "outside the index's folder"),
        ("distributions: {noetic: {distribution: ['file:///etc/passwd']}}", "no such file|cannot|No such file"),
    ],
)
def test_a_bad_index_is_one_sentence(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "index.yaml").write_text(text)
    with pytest.raises(DescriptionError, match=message):
        read_index(str(tmp_path / "index.yaml"), "noetic")


@pytest.mark.parametrize(
    "url",
    [
        "file:///home/me/secret", "/home/me", "ext::sh -c id", "ssh://-oProxyCommand=id/x", "--upload-pack=id",
        "https://x.org/../../etc", "git@-oProxyCommand=id:x", "https://x.org/a b", "https://x.org/a\n", "ftp://x.org/a",
    ],
)  # fmt: skip
def test_addresses_that_do_more_than_fetch_are_refused(url: str) -> None:
    with pytest.raises(ValueError, match="is refused"):
        https_address(url)


def test_an_address_that_needs_a_key_becomes_a_public_one() -> None:
    assert https_address("git@github.com:me/arm.git") == "https://github.com/me/arm.git"
    assert https_address("ssh://git@github.com/me/arm.git") == "https://github.com/me/arm.git"


REPOS = "repositories:\n  {folder}: {{type: {kind}, url: {url}, version: {version}}}\n"
ROSINSTALL = "- {kind}: {{local-name: {folder}, uri: {url}, version: {version}}}\n"
GOOD = {"folder": "arm", "kind": "git", "url": "https://x.org/arm.git", "version": "main"}


@pytest.mark.parametrize("form", [REPOS, ROSINSTALL])
def test_lists_of_repositories_are_read(form: str) -> None:
    assert read_repository_list(form.format(**GOOD), "a.repos") == [("arm", "https://x.org/arm.git", "main")]


@pytest.mark.parametrize("form", [REPOS, ROSINSTALL])
@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("folder", "../arm", "folder '../arm' is refused"),
        ("folder", "/etc/cron.d", "folder '/etc/cron.d' is refused"),
        ("folder", "a/.git/hooks", "folder 'a/.git/hooks' is refused"),
        ("version", "--orphan", "version '--orphan' is refused"),
        ("url", "file:///home", "address 'file:///home' is refused"),
        ("kind", "hg", "only git"),
    ],
)
def test_lists_cannot_leave_the_workspace(form: str, field: str, value: str, message: str) -> None:
    with pytest.raises(DescriptionError, match=message):
        read_repository_list(form.format(**{**GOOD, field: value}), "a.repos")


def test_keys_of_python_libraries_have_pypis_names() -> None:
    keys = ("python3-opencv", "python-yaml", "python3-serial", "python3-gtts-pip", "python3-tk", "libusb-dev")
    assert [python_library(key) for key in keys] == ["opencv-python", "pyyaml", "pyserial", "gtts", None, None]
