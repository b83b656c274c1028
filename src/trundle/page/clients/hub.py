"""Clients and channels of the page, and the messages to all clients."""

import asyncio
import time
from collections.abc import Callable, Iterable, Mapping
from typing import Protocol

from .channel import Channel
from .connection import Connection
from .poll_timing import PollTiming
from .protocol import CONTROL_CAPABILITIES, WARNING, time_message
from .send_flow import NEWEST
from .server_messages import RemoveStatus, ServerInfo

_TIME_PERIOD_S = 0.05
_BEAT_PERIOD_S = 1.0
_TIME = "time"


class Polled(Protocol):
    """Part of the page that is polled while clients are connected."""

    def poll(self, now_s: float, time_ns: int) -> bool:
        """Send what is due; return True if new data came in.

        Args:
            now_s: monotonic time [s].
            time_ns: page's time [ns].
        """
        ...


class DropsChannel(Channel):
    """Each client's counts of dropped messages."""

    def __init__(self) -> None:
        super().__init__("trundle/drops", encoding="json", trundle_only=True)


class Hub:
    """Channels and conditions, advertised to all clients; used on the loop only."""

    def __init__(
        self, *, session_id: str, capabilities: tuple[str, ...], simulated_time_ns: Callable[[], int | None]
    ) -> None:
        """Create it.

        Args:
            session_id: distinguishes this server from an earlier one at the same address.
            capabilities: server's capabilities, by the protocol's names.
            simulated_time_ns: returns the simulated time [ns]; None: wall time is used.
        """
        self.clients: set[Connection] = set()
        """Clients with channels."""
        self._connected: set[Connection] = set()
        """All clients, also those that only drive."""
        self.polled: list[Polled] = []
        self._session_id = session_id
        self._capabilities = capabilities
        self._simulated_time_ns = simulated_time_ns
        self._channels: dict[int, Channel] = {}
        self._conditions: dict[str, str] = {}
        """Current status messages by id."""
        self._drops = DropsChannel()
        self.add_channels([self._drops])
        self._time_ns: int | None = None
        self._time_due_s = self._beat_due_s = 0.0
        self._has_clients = asyncio.Event()

    # -- channels

    @property
    def channels(self) -> Iterable[Channel]:
        """All channels."""
        return self._channels.values()

    def find(self, channel_id: int) -> Channel | None:
        """Return the channel with an id."""
        return self._channels.get(channel_id)

    def add_channels(self, channels: Iterable[Channel]) -> None:
        """Advertise new channels."""
        added = list(channels)
        self._channels |= {channel.id: channel for channel in added}
        for client in self.clients:
            client.offer(added)

    def remove_channels(self, channels: Iterable[Channel]) -> None:
        """Unadvertise channels."""
        removed = list(channels)
        for channel in removed:
            del self._channels[channel.id]
        for client in list(self.clients):
            client.withdraw(removed)

    # -- clients

    def add_client(self, client: Connection) -> None:
        """Add a client; unless it only drives, send it the server's capabilities, channels and conditions."""
        self._connected.add(client)
        self._has_clients.set()
        if client.only_drives:
            return
        self.clients.add(client)
        refused = CONTROL_CAPABILITIES if client.is_view_only else ()
        capabilities = tuple(capability for capability in self._capabilities if capability not in refused)
        client.send(ServerInfo(capabilities=capabilities, session_id=self._session_id))
        client.offer(list(self._channels.values()))
        for status_id, message in self._conditions.items():
            client.send_status(WARNING, message, status_id)

    def remove_client(self, client: Connection) -> None:
        """Remove a client that has disconnected."""
        self._connected.discard(client)
        self.clients.discard(client)
        client.end_subscriptions()
        if not self._connected:
            self._has_clients.clear()

    def set_condition(self, status_id: str, message: str | None) -> None:
        """Show a status message until it is replaced; None: remove it."""
        if message == self._conditions.get(status_id):
            return
        if message is None:
            del self._conditions[status_id]
            for client in self.clients:
                client.send(RemoveStatus((status_id,)))
            return
        self._conditions[status_id] = message
        for client in self.clients:
            client.send_status(WARNING, message, status_id)

    @property
    def conditions(self) -> Mapping[str, str]:
        """Current status messages by id."""
        return self._conditions

    # -- time

    def now_ns(self) -> int:
        """Return the time for messages [ns]: simulated time if there is one, else wall time."""
        simulated = self._simulated_time_ns()
        return time.time_ns() if simulated is None else simulated

    async def wait_client(self) -> None:
        """Wait until a client is connected."""
        await self._has_clients.wait()

    async def run(self) -> None:
        """Poll while clients are connected, soon after each time that the owner writes."""
        timing = PollTiming()
        while True:
            await self._has_clients.wait()
            started = time.monotonic()
            is_new = [part.poll(started, self.now_ns()) for part in self.polled]
            self._send_time(started)
            self._send_beats(started)
            wait_s = timing.wait_s(started, is_new=any(is_new))
            await asyncio.sleep(max(0.0, started + wait_s - time.monotonic()))

    def _send_time(self, now_s: float) -> None:
        now_ns = self.now_ns()
        if now_ns == self._time_ns or now_s < self._time_due_s:
            return
        self._time_due_s = now_s + _TIME_PERIOD_S
        self._time_ns = now_ns
        message = (time_message(now_ns),)
        for client in self.clients:
            client.send_binary(message, _TIME, NEWEST)

    def _send_beats(self, now_s: float) -> None:
        """Send counts of dropped messages, and marks."""
        if now_s < self._beat_due_s:
            return
        self._beat_due_s = now_s + _BEAT_PERIOD_S
        for client in list(self.clients):
            client.outbox.beat()
            if client in self._drops.clients:
                client.send_drops(self._drops, self.now_ns())
