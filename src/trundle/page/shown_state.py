"""State of a page: the messages from which a new server can show it again."""

from collections.abc import Iterator

from .wire import AddFile, OpenMailbox, SetNotice, SetSession, SetWorld, ToServer


class ShownState:
    """Newest messages of the owner; a message replaces the earlier one of the same kind and name."""

    def __init__(self) -> None:
        self._session: SetSession | None = None
        self._notices: dict[str, SetNotice] = {}
        self._files: dict[str, AddFile] = {}
        self._world: SetWorld | None = None
        self._mailboxes: dict[str, OpenMailbox] = {}

    def record(self, message: ToServer) -> None:
        """Store a message to the server."""
        match message:
            case SetSession():
                self._session = message
            case SetNotice(notice, text):
                self._notices.pop(notice, None)
                if text is not None:
                    self._notices[notice] = message
            case AddFile(url, _):
                self._files[url] = message
            case SetWorld():
                self._world = message
                self._files = {url: file for url, file in self._files.items() if url in message.urls}
            case OpenMailbox(stream, _):
                self._mailboxes[stream] = message
            case _:  # answers
                pass

    def messages(self) -> Iterator[ToServer]:
        """Return the messages, in an order that a server can follow."""
        if self._session is not None:
            yield self._session
        yield from self._notices.values()
        yield from self._files.values()
        if self._world is not None:
            yield self._world
        yield from self._mailboxes.values()
