"""Another user of the machine is refused everywhere by a page on loopback, and cannot read the token."""

import base64
import json
import os
import stat
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from tests.page.uploads.test_uploads import CONFIG, zipped

from trundle.app.cli.main import main
from trundle.base.http.page_address import PageAddress
from trundle.base.ownership import runtime_folders
from trundle.page import PageServer, Session

NOBODY = 65534
PATHS = (
    "/", "/index.html", "/session.json", "/world/model.glb", "/camera.png?width=64&height=64", "/model.png?model=cart",
    "/model.glb?model=cart", "/icon.svg", "/assets/none.js", "/?view_only", "/?token=", "/?token=guess",
)  # fmt: skip
INTRUDER = """
import base64, encodings.idna, json, os, socket, sys  # before the permission to read them is lost
if os.getuid() == 0:
    os.setgroups([])
    os.setgid(65534)
    os.setuid(65534)
host, port, file, paths, upload = json.load(sys.stdin)
def ask(head, body=b""):
    with socket.create_connection((host, port)) as sock:
        sock.sendall(head.encode() + b"\\r\\n\\r\\n" + body)
        return sock.recv(100).split()[1].decode()
about = f"Host: {host}:{port}\\r\\nConnection: close"
answers = {path: ask(f"GET {path} HTTP/1.1\\r\\n{about}") for path in paths}
upgrade = "Upgrade: websocket\\r\\nConnection: Upgrade\\r\\nSec-WebSocket-Version: 13\\r\\n"
upgrade += "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\\r\\nSec-WebSocket-Protocol: "
for name in ("trundle.v1", "foxglove.websocket.v1", "foxglove.sdk.v1"):
    answers[name] = ask(f"GET / HTTP/1.1\\r\\nHost: {host}:{port}\\r\\nOrigin: http://{host}:{port}\\r\\n{upgrade}{name}")
form = b'--b\\r\\nContent-Disposition: form-data; name="x.zip"; filename="x.zip"\\r\\n\\r\\n'
form += base64.b64decode(upload) + b"\\r\\n--b--\\r\\n"
kind = f"Content-Type: multipart/form-data; boundary=b\\r\\nContent-Length: {len(form)}"
answers["upload"] = ask(f"POST /models HTTP/1.1\\r\\n{about}\\r\\n{kind}", form)
try:
    answers["file"] = open(file).read()
except PermissionError:
    answers["file"] = "unreadable"
json.dump(answers, sys.stdout)
"""


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[PageServer]:
    (tmp_path / "run").mkdir(mode=0o700)
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path / "run"))
    with PageServer.start(Session(title="t", kind="simulation"), at=PageAddress(port=0)) as page:
        yield page


def _link_file() -> Path:
    (file,) = runtime_folders(os.environ)[0].glob("page-*.json")
    return file


@pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="only root can act as another user")
def test_another_user_is_refused_and_cannot_read_the_link(page: PageServer) -> None:

    address = urlsplit(page.url)
    model = zipped({"m/model.config": CONFIG.format("m"), "m/model.sdf": "<sdf/>", "m/code.py": "print('ran')"})
    arguments = (address.hostname, address.port, str(_link_file()), PATHS, base64.b64encode(model).decode())
    done = subprocess.run(
        [sys.executable, "-I", "-c", INTRUDER], input=json.dumps(arguments), capture_output=True, text=True, cwd="/"
    )

    assert done.stderr == ""
    answers = json.loads(done.stdout)
    assert answers.pop("file") == "unreadable"
    assert set(answers.values()) == {"403"}, answers
    assert page.uploads is None


@pytest.mark.skipif(not Path("/proc/self/cmdline").exists(), reason="needs /proc")
def test_the_token_is_not_in_the_process_list(page: PageServer) -> None:
    about = Path(f"/proc/{page.process_id}")
    token = page.url.partition("token=")[2].encode()

    assert token not in (about / "cmdline").read_bytes()
    assert token not in (about / "environ").read_bytes()


@pytest.mark.skipif(os.name != "posix", reason="modes of files are POSIX'")
def test_link_files_are_private_and_removed_with_the_page(page: PageServer) -> None:
    file = _link_file()

    assert [stat.S_IMODE(path.stat().st_mode) for path in (file.parent, file)] == [0o700, 0o600]
    page.close()
    assert not file.exists()


def test_a_folder_that_others_can_enter_is_not_used(tmp_path: Path) -> None:
    environment = {"XDG_RUNTIME_DIR": str(tmp_path)}
    (tmp_path / "trundle").mkdir()
    (tmp_path / "trundle").chmod(0o755)

    assert tmp_path / "trundle" not in runtime_folders(environment)
    (tmp_path / "trundle").chmod(0o700)
    assert runtime_folders(environment)[0] == tmp_path / "trundle"


def _printed(capsys: pytest.CaptureFixture[str], *words: str) -> list[str]:
    assert main(["page", "link", *words]) == 0
    return capsys.readouterr().out.splitlines()


def test_the_command_prints_the_links_of_running_pages(page: PageServer, capsys: pytest.CaptureFixture[str]) -> None:
    port = str(urlsplit(page.url).port)
    dead = _link_file().with_name("page-1-1.json")
    dead.write_text(_link_file().read_text().replace(port, "1"))

    assert page.url in _printed(capsys)
    assert not dead.exists()
    assert _printed(capsys, "--port", port) == [page.url]
    assert _printed(capsys, "--port", port, "--view-only") == [page.view_url]
    assert _printed(capsys, "--port", port, "--foxglove") == [page.foxglove_url]
    page.close()
    assert main(["page", "link", "--port", port]) == 1
    assert f"no page of this user runs at port {port}" in capsys.readouterr().err
