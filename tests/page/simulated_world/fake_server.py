"""Fake of the page's server that records calls."""

import queue
from typing import Any, cast

import msgspec
import numpy as np

from trundle.page import PageAction, PageServer, Request, Session
from trundle.page.requests.answers import DONE, Answer
from trundle.page.shared_page import SharedPage
from trundle.page.world.manifest import Manifest
from trundle.page.world.profile import Profile
from trundle.page.world.reference import Differences
from trundle.page.world.streams import SeriesHead


class FakeServer:
    """Fake of `trundle.page.PageServer`; by default, every stream is watched."""

    url = "http://localhost:1"
    generation = 0
    uploads = None

    def __init__(self) -> None:
        self.watched: set[str] | None = None
        self.pending: list[Request] = []
        self._actions: dict[int, PageAction] = {}
        self.answers: dict[int, str | None] = {}
        self.fields: dict[int, dict[str, Any]] = {}
        self.worlds: list[tuple[dict[str, Any], dict[str, bytes]]] = []
        self.states: list[Any] = []
        self.poses: list[tuple[int, Any]] = []
        self.joints: list[tuple[int, Any]] = []
        self.lines: list[Any] = []
        self.contacts: list[Any] = []
        self.ranges: list[Any] = []
        self.images: list[tuple[str, int, Any]] = []
        self.pictures: queue.SimpleQueue[tuple[int, Any]] = queue.SimpleQueue()
        self.notices: list[tuple[str, str | None]] = []
        self.plotted: tuple[str, ...] = ()
        self.series: list[tuple[int, dict[str, Any], Any]] = []
        self.profiles: list[dict[str, Any]] = []
        self.differences: list[dict[str, Any]] = []
        self.is_closed = False

    def ask(self, action: PageAction) -> int:
        """Add a client's request; return its id."""
        self.pending.append(Request(len(self.pending) + len(self.answers), action))
        self._actions[self.pending[-1].id] = action
        return self.pending[-1].id

    def requests(self, **_: object) -> list[Request]:
        pending, self.pending = self.pending, []
        return pending

    def set_node(self, _: object) -> None:
        pass

    def set_session(self, session: Session) -> None:
        self.session = session

    def set_notice(self, notice_id: str, text: str | None) -> None:
        self.notices.append((notice_id, text))

    def respond(self, request_id: int, error: str | None = None, answer: Answer = DONE) -> None:
        if error is None and request_id in self._actions:
            assert isinstance(answer, self._actions[request_id].answer), "the answer has a type of the request's class"
        self.fields[request_id] = sent(answer)
        self.answers[request_id] = error

    def respond_picture(self, request_id: int, picture: bytes | str) -> None:
        self.pictures.put((request_id, picture))

    def is_watched(self, stream: str) -> bool:
        return self.watched is None or stream in self.watched

    def set_world(self, manifest: Manifest, files: dict[str, bytes]) -> None:
        self.worlds.append((sent(manifest), files))

    def put_state(self, state: Any) -> None:
        self.states.append(state)

    def put_poses(self, time_ns: int, poses: Any) -> None:
        self.poses.append((time_ns, np.array(poses)))

    def put_joints(self, time_ns: int, joints: Any) -> None:
        self.joints.append((time_ns, np.array(joints)))

    def put_series(self, first: int, head: SeriesHead, rows: Any) -> None:
        self.series.append((first, sent(head), np.array(rows)))

    def put_performance(self, profile: Profile) -> None:
        self.profiles.append(sent(profile))

    def put_differences(self, differences: Differences) -> None:
        self.differences.append(sent(differences))

    def put_lines(self, time_ns: int, lines: Any) -> None:
        self.lines.append((time_ns, list(lines)))

    def put_contacts(self, time_ns: int, contacts: Any) -> None:
        self.contacts.append((time_ns, np.array(contacts)))

    def put_ranges(self, time_ns: int, lines: Any) -> None:
        self.ranges.append((time_ns, list(lines)))

    def put_image(self, topic: str, time_ns: int, rgb: Any) -> None:
        self.images.append((topic, time_ns, rgb))

    def close(self) -> None:
        self.is_closed = True


def sent(message: msgspec.Struct) -> dict[str, Any]:
    """Return a message as a client gets it."""
    return msgspec.json.decode(msgspec.json.encode(message))


def shared_page() -> tuple[SharedPage, FakeServer]:
    """Return a page without ROS, with a fake server."""
    server = FakeServer()
    return SharedPage(say=print, server=cast(PageServer, server)), server
