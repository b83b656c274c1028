"""Channel of the session: what the page is for, at subscription and whenever it changes."""

from collections.abc import Callable

from .channel import Channel, Client
from .streams import SESSION


class SessionChannel(Channel):
    """Content of `/session.json`; never dropped."""

    def __init__(self, content: Callable[[], bytes]) -> None:
        """Create; `content` returns the session as JSON."""
        super().__init__(SESSION, encoding="json", is_droppable=False, is_own=True)
        self._content = content

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        client.send_message(self, 0, (self._content(),))

    def publish_change(self) -> None:
        """Send it to every client, as it has changed."""
        if self.clients:
            self.publish(0, (self._content(),))
