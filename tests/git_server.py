"""A git server on loopback for tests."""

import os
import shutil
import signal
import socket
import subprocess
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from pathlib import Path
from time import sleep

import pytest
from tests.graphs import free_port

_NOBODY = ("-c", "user.name=a", "-c", "user.email=a@b", "-c", "init.defaultBranch=main")


def manifest(name: str, *needs: str, build: str = "catkin") -> str:
    """Return a package.xml."""
    depends = "".join(f"<exec_depend>{package}</exec_depend>" for package in needs)
    return f"""<package format="2"><name>{name}</name><version>0.1.0</version><license>BSD</license>
<buildtool_depend>{build}</buildtool_depend>{depends}
<export><build_type>{build}</build_type></export></package>"""


class GitServer:
    """Repositories below a folder, served by git daemon."""

    def __init__(self, folder: Path, port: int) -> None:
        self.folder = folder
        self.address = f"git://127.0.0.1:{port}"

    def add(self, name: str, branches: Mapping[str, Mapping[str, str]], links: Mapping[str, str] | None = None) -> str:
        """Make a repository and return its URL.

        Args:
            name: OWNER/NAME.
            branches: branch → path → text; the last is the default branch.
            links: path → target of symbolic links, on every branch.
        """
        folder = self.folder / name
        folder.mkdir(parents=True)
        self._git(folder, "init", "-q")
        for branch, files in branches.items():
            self._git(folder, "checkout", "-q", "--orphan", branch)
            for file in [path for path in folder.iterdir() if path.name != ".git"]:
                subprocess.run(["rm", "-rf", str(file)], check=True)
            for path, text in files.items():
                (folder / path).parent.mkdir(parents=True, exist_ok=True)
                (folder / path).write_text(text)
            for path, target in (links or {}).items():
                (folder / path).symlink_to(target)
            self._git(folder, "add", "-A")
            self._git(folder, "commit", "-q", "-m", branch)
        return f"{self.address}/{name}"

    def _git(self, folder: Path, *words: str) -> None:
        subprocess.run(["git", *_NOBODY, *words], cwd=folder, check=True, capture_output=True)


@contextmanager
def git_server(folder: Path) -> Generator[GitServer]:
    """Serve repositories until the end of the block."""
    if shutil.which("git") is None:
        pytest.skip("git is not installed")
    folder.mkdir(exist_ok=True)
    port = free_port()
    words = ["git", "daemon", f"--base-path={folder}", "--export-all", "--listen=127.0.0.1", f"--port={port}"]
    daemon = subprocess.Popen([*words, "--reuseaddr", str(folder)], stderr=subprocess.PIPE, start_new_session=True)
    try:
        while True:
            try:
                socket.create_connection(("127.0.0.1", port)).close()
                break
            except ConnectionRefusedError:
                assert daemon.poll() is None, daemon.stderr
                sleep(0.02)
        yield GitServer(folder, port)
    finally:
        os.killpg(daemon.pid, signal.SIGTERM)
        daemon.communicate()
