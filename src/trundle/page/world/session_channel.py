"""Channel of the session, sent at subscription and after each change."""

from collections.abc import Callable

from ..clients.channel import Channel, Client
from .streams import SESSION


class SessionChannel(Channel):
    """Content of `/session.json`; never dropped."""

    def __init__(self, content: Callable[[bool], bytes]) -> None:
        """Create it; `content` returns the session as JSON, given whether the client is view-only."""
        super().__init__(SESSION, encoding="json", is_droppable=False, trundle_only=True)
        self._content = content

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        client.send_message(self, 0, (self._content(client.is_view_only),))

    def publish_change(self) -> None:
        """Send the changed session to every client."""
        for client in self.clients:
            client.send_message(self, 0, (self._content(client.is_view_only),))
