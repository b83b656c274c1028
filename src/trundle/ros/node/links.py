"""What a node's servers and the master ask of it: its topics and services, its links, and who publishes what."""

from typing import Any

from .publisher import Publisher
from .service import Service
from .subscription import Subscription


class NodeLinks:
    """The topics and services of one node, looked at on the loop."""

    _publishers: dict[str, Publisher]
    _subscriptions: dict[str, list[Subscription]]
    _publisher_uris: dict[str, list[str]]
    _services: dict[str, Service]

    @property
    def publishers(self) -> list[Publisher]:
        """What this node publishes."""
        return list(self._publishers.values())

    def publisher(self, topic: str) -> Publisher | None:
        """Find a publisher by its topic's global name."""
        return self._publishers.get(topic)

    def service(self, name: str) -> Service | None:
        """Find a service by its global name."""
        return self._services.get(name)

    def subscribed_topics(self) -> list[tuple[str, str]]:
        """Topics with the type this node expects."""
        return [(topic, subscriptions[0].type) for topic, subscriptions in self._subscriptions.items()]

    def connections(self) -> list[list[Any]]:
        """All links, as getBusInfo tells them."""
        links = [link for publisher in self._publishers.values() for link in publisher.connections()]
        return links + [
            link
            for subscriptions in self._subscriptions.values()
            for subscription in subscriptions
            for link in subscription.connections()
        ]

    def statistics(self) -> list[list[Any]]:
        """Bytes and messages, as getBusStats tells them."""
        subscriptions = [s for subscriptions in self._subscriptions.values() for s in subscriptions]
        return [[p.statistics() for p in self._publishers.values()], [s.statistics() for s in subscriptions], []]

    def publishers_changed(self, topic: str, uris: list[str]) -> None:
        """Follow what the master says about a topic's publishers."""
        self._publisher_uris[topic] = uris
        for subscription in self._subscriptions.get(topic, []):
            subscription.follow(uris)
