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

_OTHER_UID = 65534
"""User id of `nobody`."""

_BECOME = f"""
import os, socket, struct, sys
os.setgroups([]); os.setgid({_OTHER_UID}); os.setuid({_OTHER_UID})
exec(sys.argv.pop(1))
"""
"""Starts as root, as only root may be able to read the interpreter."""


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
    output, errors = Stranger().run("print(os.getuid())")
    if output.strip() != str(_OTHER_UID):
        pytest.skip(f"no program can be run as another user here: {errors.strip()[-200:]}")
    return Stranger()


@pytest.fixture
def shared_folder() -> Iterator[Path]:
    """A world-writable, sticky folder like /tmp."""
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        Path(folder).chmod(0o1777)
        yield Path(folder)


@pytest.mark.parametrize("named", [False, True])
def test_a_mailbox_cannot_be_read_or_written_by_another_user(
    stranger: Stranger, named: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    if named:
        monkeypatch.delattr(os, "memfd_create")
    mailbox = Mailbox.create(1000)
    try:
        for mode in ("rb", "r+b"):
            _, errors = stranger.run("open(*sys.argv[1:])", mailbox.address.path, mode)
            assert "PermissionError" in errors
    finally:
        mailbox.unlink()


def test_a_topics_socket_disconnects_another_user(stranger: Stranger) -> None:
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

        with socket.socket(socket.AF_UNIX) as client:
            client.settimeout(60)
            client.connect(f"\0{name}")
            client.sendall(b"\x04\x00\x00\x00\xff\xff\xff\xff")  # an invalid header, which is read
            assert client.recv(100) == b""


def test_a_node_does_not_connect_to_another_users_socket(stranger: Stranger) -> None:
    """A publisher may name any socket; if it is another user's, TCP is used instead."""
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
        with ThreadPoolExecutor(1) as thread:  # browser tests leave a running loop in this thread
            thread.submit(asyncio.run, connect()).result()
        other.communicate()


def _part() -> RawPart:
    corners = np.eye(3)
    return RawPart(names=("a",), vertices=corners, faces=np.array([[0, 1, 2]]))


def test_another_users_cache_is_not_used(
    stranger: Stranger, shared_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(shared_folder / "cache"))
    save_parts("k", [_part()])
    content = (shared_folder / "cache/trundle/meshes/k.npz").read_bytes()
    assert load_parts("k") is not None
    assert "PermissionError" in stranger.run("os.listdir(sys.argv[1])", shared_folder / "cache/trundle/meshes")[1]

    other_cache = shared_folder / "theirs"
    program = "os.makedirs(sys.argv[1]); os.chmod(sys.argv[1], 0o777)"
    assert stranger.run(program, other_cache / "trundle/meshes") == ("", "")
    (other_cache / "trundle/meshes/k.npz").write_bytes(content)
    monkeypatch.setenv("XDG_CACHE_HOME", str(other_cache))
    assert load_parts("k") is None
    save_parts("other", [_part()])
    assert [file.name for file in (other_cache / "trundle/meshes").iterdir()] == ["k.npz"]


def test_another_users_log_folder_is_not_used(stranger: Stranger, shared_folder: Path) -> None:
    assert stranger.run("os.mkdir(sys.argv[1])", shared_folder / "gazebo") == ("", "")

    folder = log_folder({"ROS_LOG_DIR": str(shared_folder), "HOME": str(shared_folder)}, "gazebo")

    assert folder.parent == shared_folder
    assert folder != shared_folder / "gazebo"
    assert is_owned_by_user(folder)


def test_a_link_in_place_of_the_temporary_file_is_not_followed(tmp_path: Path) -> None:
    client, out = tmp_path / "ours", tmp_path / "out.sdf"
    client.write_text("precious")
    (tmp_path / ".out.sdf.part").symlink_to(client)

    write_atomically(out, "new")

    assert (client.read_text(), out.read_text(), out.is_symlink()) == ("precious", "new", False)


def test_folders_below_world_writable_ones_are_not_owned(tmp_path: Path) -> None:
    folder = tmp_path / "a/b"
    folder.mkdir(parents=True)
    assert is_owned_by_user(folder)
    assert not is_owned_by_user(tmp_path / "none")
    folder.parent.chmod(0o777)
    assert not is_owned_by_user(folder)
    folder.parent.chmod(0o1777)
    assert is_owned_by_user(folder)


def test_home_folder_falls_back_to_the_system_never_to_a_shared_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    assert home_folder({"HOME": "/home/me"}) == Path("/home/me")
    monkeypatch.delenv("HOME", raising=False)
    assert home_folder({}) == Path("~").expanduser()
    monkeypatch.setenv("HOME", "relative")
    assert not home_folder({}).exists() or home_folder({}) == Path(os.devnull)
