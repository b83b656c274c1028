"""The page's process: it answers, gives ports and memory back, and ends with its owner."""

import contextlib
import os
import signal
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from trundle.diagnostics import UsageError
from trundle.viewer import Viewer, ViewerScene, ViewerState

_OWNER = """
import sys, time
import numpy as np
from trundle.render import Scene
from trundle.viewer import Viewer, ViewerScene
viewer = Viewer.start(ViewerScene(title="empty", scene=Scene(bodies=(), shapes=())), port=0)
print(viewer.url, viewer._process.pid, flush=True)
try:
    sys.stdin.read()
except KeyboardInterrupt:
    viewer.close()
"""


def _boxes_of(pid: int) -> list[Path]:
    return [path for folder in ("/dev/shm", "/tmp") for path in Path(folder).glob(f"trundle-{pid}-*")]


def _get(url: str) -> int:
    with urllib.request.urlopen(url, timeout=30) as answer:
        return int(answer.status)


def test_the_page_answers_as_soon_as_start_returns(viewer: Viewer) -> None:
    assert viewer.url.startswith("http://127.0.0.1:")
    assert _get(viewer.url) == 200
    assert viewer.alive


def test_close_frees_the_port_and_leaves_no_process_or_memory(
    car_scene: Callable[..., ViewerScene], car_state: Callable[..., ViewerState]
) -> None:
    viewer = Viewer.start(car_scene(), port=0, state=car_state())
    port = int(viewer.url.rpartition(":")[2])
    viewer.image(0, np.zeros((240, 320, 3), dtype=np.uint8))

    viewer.close()
    viewer.close()

    assert not viewer.alive
    assert _boxes_of(os.getpid()) == []
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        probe.bind(("127.0.0.1", port))


def test_a_port_asked_for_and_taken_is_an_error_that_names_it(car_scene: Callable[..., ViewerScene]) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(UsageError, match=rf"127\.0\.0\.1:{port}: Address already in use; leave out the port"):
            Viewer.start(car_scene(), port=port)


def test_an_unknown_host_is_an_error_that_names_it(car_scene: Callable[..., ViewerScene]) -> None:
    with pytest.raises(UsageError, match=r"at host 'no\.such\.host\.invalid'"):
        Viewer.start(car_scene(), host="no.such.host.invalid")


def test_showing_to_a_page_that_died_costs_nothing(viewer: Viewer, car_state: Callable[..., ViewerState]) -> None:
    viewer._process.kill()
    viewer._process.wait()

    viewer.show(car_state())
    viewer.image(0, np.zeros((240, 320, 3), dtype=np.uint8))

    assert not viewer.alive
    assert viewer.requests() == []


def test_an_image_larger_than_a_thumbnail_is_thinned(viewer: Viewer) -> None:
    viewer.image(0, np.zeros((1080, 1920, 3), dtype=np.uint8))

    assert viewer.alive


def test_nonsense_from_the_net_is_dropped_in_silence(viewer: Viewer, capfd: pytest.CaptureFixture[str]) -> None:
    """Any connected client may send anything; the page goes on and prints no traceback."""
    address = ("127.0.0.1", int(viewer.url.rpartition(":")[2]))
    for nonsense in (b"\x00\xff" * 100, b"GET /../../etc/passwd HTTP/1.1\r\n\r\n", b""):
        with socket.create_connection(address) as connection:
            connection.sendall(nonsense)
            connection.shutdown(socket.SHUT_WR)
            connection.settimeout(30)
            while connection.recv(1000):
                pass
    with connect(f"ws://127.0.0.1:{address[1]}", subprotocols=[Subprotocol(f"viser-v{version('viser')}")]) as client:
        client.send(b"\x99nonsense")
        with contextlib.suppress(ConnectionClosed):
            while True:
                client.recv(timeout=30)

    assert _get(viewer.url) == 200
    assert capfd.readouterr() == ("", "")


def _gone(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return True
    # An orphan of a container without an init stays as a zombie: dead, though its number is still taken.
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_the_page_ends_with_its_owner_in_silence(how: signal.Signals) -> None:
    """Ctrl-C reaches the owner's whole group; a killed owner says nothing at all."""
    owner = subprocess.Popen(
        [sys.executable, "-c", _OWNER],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert owner.stdout is not None
    url, pid = owner.stdout.readline().split()
    assert _get(url) == 200

    os.killpg(owner.pid, how)
    _, complaints = owner.communicate(timeout=30)  # the page inherits stderr: this also waits for its end

    assert complaints == ""
    deadline = time.monotonic() + 30
    while not _gone(int(pid)):  # its stderr ends a moment before it does
        assert time.monotonic() < deadline
        time.sleep(0.01)
    with pytest.raises(urllib.error.URLError):
        _get(url)
    assert _boxes_of(owner.pid) == []


def test_scenes_replaced_faster_than_they_are_drawn_leave_the_last(
    viewer: Viewer, car_scene: Callable[..., ViewerScene], car_state: Callable[..., ViewerState]
) -> None:
    """A launch spawns its robots one after the other: each is a new scene before the page has drawn the last one."""
    for _ in range(20):
        viewer.replace(car_scene(), state=car_state())

    time.sleep(0.5)
    assert viewer.alive
    assert _get(viewer.url) == 200
