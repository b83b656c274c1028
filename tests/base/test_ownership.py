"""A second user of the machine cannot read, write or replace this user's files and sockets."""

import asyncio
import os
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from tests.graphs import running_graph

from trundle.base.atomic_write import write_atomically
from trundle.base.ownership import home_folder, is_owned_by_user
from trundle.live.launch.logs import log_folder
from trundle.page.mailbox import Mailbox
from trundle.robots.meshes import RawPart, load_parts, save_parts
from trundle.ros import blocking_call
from trundle.ros.transport.unix_sockets import UNIXROS, connect_unix

_OTHER = 65534
"""User id of `nobody`, without rights."""

_BECOME = f"""
import os, socket, struct, sys
os.setgroups([]); os.setgid({_OTHER}); os.setuid({_OTHER})
exec(sys.argv.pop(1))
"""
"""The interpreter may be where only root finds it: it is started first."""


class Stranger:
    """Runs programs as another user."""

    def start(self, program: str, *arguments: object) -> "subprocess.Popen[str]":
        words = [sys.executable, "-I", "-S", "-c", _BECOME, program, *map(str, arguments)]
        pipe = subprocess.PIPE
        return subprocess.Popen(words, cwd="/", stdin=pipe, stdout=pipe, stderr=pipe, text=True)

    def run(self, program: str, *arguments: object) -> tuple[str, str]:
        """Return a program's stdout and stderr."""
        return self.start(program, *arguments).communicate(timeout=60)


@pytest.fixture
def stranger() -> Stranger:
    if not hasattr(os, "geteuid") or os.geteuid() != 0:
        pytest.skip("only root can become another user")
    said, complaints = Stranger().run("print(os.getuid())")
    if said.strip() != str(_OTHER):
        pytest.skip(f"no program can be run as another user here: {complaints.strip()[-200:]}")
    return Stranger()


@pytest.fixture
def for_all() -> Iterator[Path]:
    """A folder that all write to, as /tmp."""
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        Path(folder).chmod(0o1777)
        yield Path(folder)


@pytest.mark.parametrize("named", [False, True])
def test_pictures_and_poses_are_neither_read_nor_written(
    stranger: Stranger, named: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    if named:
        monkeypatch.delattr(os, "memfd_create")
    box = Mailbox.create(1000)
    try:
        for mode in ("rb", "r+b"):
            _, complaints = stranger.run("open(*sys.argv[1:])", box.address.path, mode)
            assert "PermissionError" in complaints
    finally:
        box.unlink()


def test_a_topics_socket_hangs_up_on_another_user(stranger: Stranger) -> None:
    """The socket's name is public: /proc/net/unix lists it."""
    program = """
connection = socket.socket(socket.AF_UNIX)
connection.settimeout(30)
connection.connect("\\0" + sys.argv[1])
fields = [b"topic=/a", b"md5sum=*", b"type=*", b"callerid=/x"]
header = b"".join(struct.pack("<I", len(field)) + field for field in fields)
try:
    connection.sendall(struct.pack("<I", len(header)) + header)
    print("answered", connection.recv(100))
except ConnectionError:
    print("hung up")
"""
    with running_graph() as graph:
        node = graph.node("n")
        node.advertise("/a", "std_msgs/String")
        graph.ready(node)
        name = blocking_call(node.uri, "requestTopic", "/me", "/a", [["TCPROS"], [UNIXROS]], timeout_s=60)[2][3]

        assert stranger.run(program, name)[0].strip() in ("hung up", "answered b''")

        with socket.socket(socket.AF_UNIX) as ours:
            ours.settimeout(60)
            ours.connect(f"\0{name}")
            ours.sendall(b"\x04\x00\x00\x00\xff\xff\xff\xff")  # a header that is none, and is read
            assert ours.recv(100) == b""


def test_a_node_does_not_connect_to_another_users_socket(stranger: Stranger) -> None:
    """A publisher may name any socket; that of another user is as good as none, and TCP is used."""
    program = """
listening = socket.socket(socket.AF_UNIX)
listening.bind("\\0trundle-of-another-user")
listening.listen()
print("ready", flush=True)
sys.stdin.read()
"""

    async def connect() -> None:
        with pytest.raises(PermissionError, match="belongs to another user"):
            await connect_unix(asyncio.get_running_loop(), "\0trundle-of-another-user")

    with stranger.start(program) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "ready\n"
        with ThreadPoolExecutor(1) as thread:  # a browser's test leaves a loop in this one
            thread.submit(asyncio.run, connect()).result()
        other.communicate()


def _part() -> RawPart:
    corners = np.eye(3)
    return RawPart(names=("a",), vertices=corners, faces=np.array([[0, 1, 2]]))


def test_a_cache_that_another_user_prepared_is_not_believed(
    stranger: Stranger, for_all: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(for_all / "cache"))
    save_parts("k", [_part()])
    kept = (for_all / "cache/trundle/meshes/k.npz").read_bytes()
    assert load_parts("k") is not None
    assert "PermissionError" in stranger.run("os.listdir(sys.argv[1])", for_all / "cache/trundle/meshes")[1]

    theirs = for_all / "theirs"
    program = "os.makedirs(sys.argv[1]); os.chmod(sys.argv[1], 0o777)"
    assert stranger.run(program, theirs / "trundle/meshes") == ("", "")
    (theirs / "trundle/meshes/k.npz").write_bytes(kept)
    monkeypatch.setenv("XDG_CACHE_HOME", str(theirs))
    assert load_parts("k") is None
    save_parts("other", [_part()])
    assert [file.name for file in (theirs / "trundle/meshes").iterdir()] == ["k.npz"]


def test_a_log_folder_that_another_user_prepared_is_not_used(stranger: Stranger, for_all: Path) -> None:
    assert stranger.run("os.mkdir(sys.argv[1])", for_all / "gazebo") == ("", "")

    folder = log_folder({"ROS_LOG_DIR": str(for_all), "HOME": str(for_all)}, "gazebo")

    assert folder.parent == for_all
    assert folder != for_all / "gazebo"
    assert is_owned_by_user(folder)


def test_a_link_where_a_file_is_about_to_be_written_is_not_followed(tmp_path: Path) -> None:
    ours, out = tmp_path / "ours", tmp_path / "out.sdf"
    ours.write_text("precious")
    (tmp_path / ".out.sdf.part").symlink_to(ours)

    write_atomically(out, "new")

    assert (ours.read_text(), out.read_text(), out.is_symlink()) == ("precious", "new", False)


def test_folders_are_ours_where_no_other_user_can_change_the_way(tmp_path: Path) -> None:
    folder = tmp_path / "a/b"
    folder.mkdir(parents=True)
    assert is_owned_by_user(folder)
    assert not is_owned_by_user(tmp_path / "none")
    folder.parent.chmod(0o777)
    assert not is_owned_by_user(folder)
    folder.parent.chmod(0o1777)
    assert is_owned_by_user(folder)


def test_without_home_the_systems_is_taken_and_never_a_folder_for_all(monkeypatch: pytest.MonkeyPatch) -> None:
    assert home_folder({"HOME": "/home/me"}) == Path("/home/me")
    monkeypatch.delenv("HOME", raising=False)
    assert home_folder({}) == Path("~").expanduser()
    monkeypatch.setenv("HOME", "relative")
    assert not home_folder({}).exists() or home_folder({}) == Path(os.devnull)
