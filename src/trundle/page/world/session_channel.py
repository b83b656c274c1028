"""Channel of the session: what the page is for, at subscription and whenever it changes."""

from collections.abc import Callable

from ..clients.channel import Channel, Client
from .streams import SESSION


class SessionChannel(Channel):
    """Content of `/session.json`; never dropped."""

    def __init__(self, content: Callable[[bool], bytes]) -> None:
        """Create; `content` returns the session as JSON, by whether a client may only look."""
        super().__init__(SESSION, encoding="json", is_droppable=False, trundle_only=True)
        self._content = content

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        client.send_message(self, 0, (self._content(client.is_view_only),))

    def publish_change(self) -> None:
        """Send it to every client, as it has changed."""
        for client in self.clients:
            client.send_message(self, 0, (self._content(client.is_view_only),))
