"""Base class of nodes that subscribe to their inputs only while their outputs have subscribers."""

from collections.abc import Callable
from typing import Any

import rospy

__all__ = ("LazyTransport",)
_NOTICE_S = 5.0


class _SubscribedAtOnce(type):
    """Metaclass that, after the constructor, subscribes a node that is not lazy."""

    def __call__(cls, *args: Any, **kwargs: Any) -> Any:
        node = super().__call__(*args, **kwargs)
        if not node._is_lazy():
            node._connect()
        return node


class LazyTransport(rospy.SubscribeListener, metaclass=_SubscribedAtOnce):
    """Node that subscribes to its inputs while its outputs have subscribers; always, if `~lazy` is false."""

    subscribe: Callable[[], None]
    """Subscribes to the inputs; subclasses define it, and `unsubscribe`."""
    unsubscribe: Callable[[], None]

    def __init__(self) -> None:
        super().__init__()
        self._publishers: list[rospy.Publisher] = []
        self._connection_status: bool | None = None
        """True while the inputs are subscribed to; None before the first time."""
        rospy.Timer(rospy.Duration(_NOTICE_S), self._warn_never_subscribed, oneshot=True)

    def advertise(self, *args: Any, **kwargs: Any) -> rospy.Publisher:
        """Advertise an output; arguments are those of `rospy.Publisher` without `subscriber_listener`."""
        publisher = rospy.Publisher(*args, subscriber_listener=self, **kwargs)
        self._publishers.append(publisher)
        return publisher

    def peer_subscribe(self, *args: Any, **kwargs: Any) -> None:
        del args, kwargs
        self._connect()

    def peer_unsubscribe(self, *args: Any, **kwargs: Any) -> None:
        del args, kwargs
        has_subscribers = any(publisher.get_num_connections() > 0 for publisher in self._publishers)
        if self._connection_status and not has_subscribers and self._is_lazy():
            self.unsubscribe()
            self._connection_status = False

    def _connect(self) -> None:
        if not self._connection_status:
            self.subscribe()
            self._connection_status = True

    def _is_lazy(self) -> bool:
        return bool(rospy.get_param("~lazy", True))

    def _warn_never_subscribed(self, _: object) -> None:
        if self._connection_status is None:
            name = rospy.get_name()
            rospy.logwarn(f"[{name}] subscribes to its inputs once it has subscribers; `~lazy` false: at once")
