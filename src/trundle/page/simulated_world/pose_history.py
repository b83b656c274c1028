"""Poses of the last minutes, and replays made from them."""

from base64 import b64encode
from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import msgspec
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.page import SaveReplay
from trundle.robots.model import World
from trundle.spatial import NS_PER_S

from ..replay.page_file import replay_page
from ..replay.recorded_motion import RecordedMotion, animated_world
from ..requests.answers import ReplayPage, ReplayScene
from .controls import reason_of

_LIMIT_BYTES = 64_000_000
_MAX_WAITING = 2
_view_decoder = msgspec.json.Decoder(dict[str, object])


class PoseHistory:
    """Poses of one world over time; the oldest are dropped."""

    def __init__(self, limit_bytes: int = _LIMIT_BYTES) -> None:
        self._limit_bytes = limit_bytes
        self._rows: deque[tuple[int, NDArray[np.float32]]] = deque()

    def clear(self) -> None:
        """Remove all poses, after the world has changed."""
        self._rows.clear()

    def add(self, time_ns: int, poses: NDArray[np.float64], *, paused: bool) -> None:
        """Store the poses (bodies, 7) at a time; when an earlier time runs on, the poses after it are removed."""
        last_ns = self._rows[-1][0] if self._rows else -1
        if time_ns == last_ns or (paused and time_ns < last_ns):
            return
        while self._rows and self._rows[-1][0] >= time_ns:
            self._rows.pop()
        self._rows.append((time_ns, poses.astype(np.float32)))
        while len(self._rows) * self._rows[0][1].nbytes > self._limit_bytes:
            self._rows.popleft()

    def motion(self, world: World, title: str) -> RecordedMotion:
        """Return the stored poses as a motion.

        Raises:
            UsageError: fewer than two poses are stored.
        """
        if len(self._rows) < 2:
            raise UsageError("there is nothing to replay yet: let time run first")
        times = np.array([time_ns for time_ns, _ in self._rows]) / NS_PER_S
        poses = np.stack([poses for _, poses in self._rows]).astype(np.float64)
        return RecordedMotion(title=title, world=world, times=times, poses=poses)


class ReplaySaver:
    """Makes replays on its own thread while the simulation continues; `respond` is called there."""

    def __init__(self, respond: Callable[..., None]) -> None:
        self._respond = respond
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="trundle-page-replay")
        self._waiting = 0

    def save(self, request_id: int, action: SaveReplay, motion: Callable[[], RecordedMotion]) -> None:
        """Queue a request for a replay; return at once.

        Args:
            request_id: request to answer.
            action: format and view of the replay.
            motion: copies the stored poses, many megabytes.

        Raises:
            UsageError: too many requests wait, or there are no poses yet.
        """
        if self._waiting >= _MAX_WAITING:
            raise UsageError(f"{_MAX_WAITING} replays are being made already")
        copied = motion()
        self._waiting += 1
        self._thread.submit(self._run, request_id, action, copied)

    def _run(self, request_id: int, action: SaveReplay, motion: RecordedMotion) -> None:
        try:
            view = None if action.view is None else _view_decoder.decode(action.view)
            if action.format == "html":
                answer = ReplayPage(html=replay_page(motion, Diagnostics(), view=view))
            else:
                answer = ReplayScene(glb=b64encode(animated_world(motion, Diagnostics())).decode())
            self._respond(request_id, answer=answer)
        except TrundleError as error:
            self._respond(request_id, reason_of(error))
        except msgspec.MsgspecError as error:
            self._respond(request_id, f"the view cannot be read: {error}")
        except Exception as error:  # a fault of a writer must not end the simulation
            self._respond(request_id, f"the replay cannot be made: {type(error).__name__}: {error}")
        finally:
            self._waiting -= 1

    def close(self) -> None:
        """Stop after the current replay."""
        self._thread.shutdown(wait=False, cancel_futures=True)
