"""The page as its owner sees it: start it, show states and images, poll what people ask for."""

import contextlib
import pickle
import queue
import subprocess
import sys
import threading
from collections import deque
from typing import Self

import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import UsageError
from trundle.page_address import NONE_ALLOWED, AllowedNames, PageAddress

from .content import MAX_LINE_POINTS, ViewerScene, ViewerState
from .errors import ViewerError
from .mailbox import Mailbox
from .requests import Request
from .wire import MAX_FIGURE_BYTES, THUMBNAIL_HEIGHT_PX, THUMBNAIL_WIDTH_PX, Refused, Served, Show

_START_TIMEOUT_S = 60.0
_STOP_TIMEOUT_S = 1.5
_STATUS_BYTES = 16_384
_LINES_BYTES = 2 * 3 * 4 * MAX_LINE_POINTS
_IMAGE_HEADER_BYTES = 8


class Viewer:
    """A browser page served by a process of its own.

    One thread owns it. Nothing here waits for the page: a browser that is slow, or gone, costs the owner nothing.
    """

    def __init__(self, process: "subprocess.Popen[bytes]") -> None:
        assert process.stdin is not None
        assert process.stdout is not None
        self._process = process
        self._to_page = process.stdin
        self._replies: queue.SimpleQueue[Served | Refused | None] = queue.SimpleQueue()
        self._requests: deque[Request] = deque(maxlen=1000)
        self._listener = threading.Thread(target=self._listen, name="trundle-viewer", daemon=True)
        self._listener.start()
        self._state_box: Mailbox | None = None
        self._image_boxes: list[Mailbox] = []
        self._figure_boxes: list[Mailbox] = []
        self._url = ""

    @classmethod
    def start(
        cls,
        scene: ViewerScene,
        *,
        host: str = "127.0.0.1",
        port: int | None = None,
        allowed: AllowedNames = NONE_ALLOWED,
        state: ViewerState | None = None,
    ) -> Self:
        """Serve a page and return once it answers.

        Args:
            scene: what to draw.
            host: the address to bind; loopback unless someone asked for more.
            port: None takes 8080 or the next free one, 0 any free one.
            allowed: who is served beside the page itself.
            state: where things are at first; the camera is placed to frame it.

        Raises:
            UsageError: the host or the port asked for cannot be bound.
            ViewerError: the page's process did not start.
        """
        process = subprocess.Popen(
            [sys.executable, "-P", "-m", "trundle.viewer.page"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            # Ctrl-C reaches every process of the terminal's group; the page ends when its pipe does, not by a signal.
            start_new_session=True,
        )
        viewer = cls(process)
        try:
            viewer._send(PageAddress(host=host, port=port, allowed=allowed))
            viewer.replace(scene, state=state)
            viewer._url = viewer._await_served()
        except BaseException:
            viewer.close()
            raise
        return viewer

    @property
    def url(self) -> str:
        """Where the page is: `http://127.0.0.1:8080`; off loopback with the token that opens it."""
        return self._url

    @property
    def alive(self) -> bool:
        """Whether the page's process still runs; without it `show` and `image` do nothing."""
        return self._process.poll() is None

    def show(self, state: ViewerState) -> None:
        """Hand over the newest state; the one before it is forgotten if the page has not drawn it yet.

        Costs a copy of the poses; safe at any rate.
        """
        assert self._state_box is not None
        self._state_box.put(pickle.dumps(state, protocol=5))

    def image(self, camera_index: int, rgb: NDArray[np.uint8]) -> None:
        """Hand over a camera's newest image, (height, width, 3).

        What is larger than 640 × 480 is thinned: the page shows thumbnails.
        """
        every = max(1, -(-rgb.shape[0] // THUMBNAIL_HEIGHT_PX), -(-rgb.shape[1] // THUMBNAIL_WIDTH_PX))
        small = np.ascontiguousarray(rgb[::every, ::every, :3])
        header = np.array(small.shape[:2], dtype=np.int32).tobytes()
        self._image_boxes[camera_index].put(header + small.tobytes())

    def figure(self, index: int, svg: str) -> bool:
        """Hand over a figure's newest drawing; False: it is too large."""
        drawing = svg.encode()
        if len(drawing) > MAX_FIGURE_BYTES:
            return False
        self._figure_boxes[index].put(drawing)
        return True

    def replace(self, scene: ViewerScene, *, state: ViewerState | None = None) -> None:
        """Show another scene on the same page: models were spawned or deleted, frames appeared."""
        rows = len(scene.scene.bodies) + len(scene.frames)
        state_box = Mailbox.create(8 * (7 * rows + len(scene.joints)) + _STATUS_BYTES + _LINES_BYTES)
        image_bytes = _IMAGE_HEADER_BYTES + 3 * THUMBNAIL_WIDTH_PX * THUMBNAIL_HEIGHT_PX
        image_boxes = [Mailbox.create(image_bytes) for _ in scene.cameras]
        figure_boxes = [Mailbox.create(MAX_FIGURE_BYTES) for _ in scene.figures]
        self._forget_boxes()
        self._state_box, self._image_boxes, self._figure_boxes = state_box, image_boxes, figure_boxes
        if state is not None:
            self.show(state)
        images, figures = (tuple(box.address for box in boxes) for boxes in (image_boxes, figure_boxes))
        self._send(Show(scene=scene, state_box=state_box.address, image_boxes=images, figure_boxes=figures))

    def requests(self) -> list[Request]:
        """Return what people asked for since the last call, oldest first."""
        taken: list[Request] = []
        with contextlib.suppress(IndexError):
            while True:
                taken.append(self._requests.popleft())
        return taken

    def close(self) -> None:
        """End the page; the port is free and the process gone when this returns. May be called twice."""
        with contextlib.suppress(OSError):
            self._to_page.close()
        try:
            self._process.wait(_STOP_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._listener.join()
        if self._process.stdout is not None:
            self._process.stdout.close()
        self._forget_boxes()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _send(self, message: PageAddress | Show) -> None:
        with contextlib.suppress(OSError):  # a page that died is told by `alive`, or by the reply that never comes
            pickle.dump(message, self._to_page, protocol=5)
            self._to_page.flush()

    def _listen(self) -> None:
        """Sort what the page says until it ends; asleep in a read unless somebody presses something."""
        assert self._process.stdout is not None
        with contextlib.suppress(EOFError, OSError, pickle.UnpicklingError):
            while True:
                message: Served | Refused | Request = pickle.load(self._process.stdout)
                if isinstance(message, Served | Refused):
                    self._replies.put(message)
                else:
                    self._requests.append(message)
        self._replies.put(None)

    def _await_served(self) -> str:
        try:
            reply = self._replies.get(timeout=_START_TIMEOUT_S)
        except queue.Empty:
            raise ViewerError(f"the viewer's process did not serve its page within {_START_TIMEOUT_S:.0f} s") from None
        if isinstance(reply, Served):
            return reply.url
        if isinstance(reply, Refused):
            raise UsageError(reply.why)
        raise ViewerError(f"the viewer's process ended at once with exit code {self._process.wait()}")

    def _forget_boxes(self) -> None:
        boxes = (self._state_box, *self._image_boxes, *self._figure_boxes)
        self._state_box, self._image_boxes, self._figure_boxes = None, [], []  # first: two threads may close
        for box in boxes:
            if box is not None:
                box.unlink()
