"""Publishers and subscribers of topics."""

import threading
import traceback
import warnings
from collections.abc import Callable
from typing import Any, TypeVar

import genpy
import rosgraph.names
from genpy import Message as Message
from trundle.ros import _message_codec

from . import core, graph
from .exceptions import ROSException, ROSSerializationException
from .msg import args_kwds_to_message
from .names import resolve_name, resolve_name_without_node_name
from .publication import Publication, SubscribeListener as SubscribeListener
from .subscription import Subscription

DEFAULT_BUFF_SIZE = 65536
_Shared = TypeVar("_Shared", Publication, Subscription)


class _TopicManager:
    """Topics of this node, by name."""

    def __init__(self) -> None:
        self.pubs: dict[str, Publication] = {}
        self.subs: dict[str, Subscription] = {}
        self.lock = threading.RLock()

    def acquire(self, topics: dict[str, _Shared], kind: type[_Shared], name: str, data_class: Any) -> _Shared:
        """Return a topic, created if missing; each call needs a `release`."""
        with self.lock:
            if (shared := topics.get(name)) is None:
                shared = topics[name] = kind(name, data_class)
            shared.ref_count += 1
        return shared

    def release(self, topics: dict[str, _Shared], name: str) -> None:
        """Release a topic; the last one closes it."""
        with self.lock:
            shared = topics.get(name)
            if shared is None:
                return
            shared.ref_count -= 1
            if shared.ref_count:
                return
            del topics[name]
        shared.close()

    def get_topics(self) -> set[str]:
        """Names of all topics."""
        return {*self.pubs, *self.subs}

    def get_publications(self) -> list[list[str]]:
        """Pairs (topic, type)."""
        return [[name, publication.type] for name, publication in list(self.pubs.items())]

    def get_subscriptions(self) -> list[list[str]]:
        """Pairs (topic, type)."""
        return [[name, subscription.type] for name, subscription in list(self.subs.items())]

    def has_publication(self, resolved_name: str) -> bool:
        """True if the topic is published."""
        return resolved_name in self.pubs

    def has_subscription(self, resolved_name: str) -> bool:
        """True if the topic is subscribed to."""
        return resolved_name in self.subs


_manager = _TopicManager()


def get_topic_manager() -> _TopicManager:
    """Topics of this node."""
    return _manager


class Topic:
    """Base class of `Publisher` and `Subscriber`."""

    def __init__(self, name: Any, data_class: Any) -> None:
        if not name or not isinstance(name, str):
            raise ValueError("topic name is not a non-empty string")
        if data_class is None:
            raise ValueError("topic parameter 'data_class' is not initialized")
        if type(data_class) is not type:
            raise ValueError(f"data_class [{data_class}] is not a class")
        if not issubclass(data_class, genpy.Message):
            raise ValueError(f"data_class [{type(data_class).__name__}] is not a message data class")
        if not rosgraph.names.is_legal_name(name):
            text = f"'{name}' is not a legal ROS graph resource name. This may cause problems with other ROS tools"
            warnings.warn(text, stacklevel=3)
        resolve = resolve_name if core.is_initialized() else resolve_name_without_node_name
        self.resolved_name: Any = resolve(name)
        self.name = self.resolved_name
        self.data_class: Any = data_class
        self.type: Any = data_class._type
        self.md5sum: Any = data_class._md5sum
        self.impl: Any = None

    def get_num_connections(self) -> int:
        """Number of connections to other nodes."""
        return self.impl.get_num_connections()

    def _forget(self) -> None:
        self.impl = self.resolved_name = self.type = self.md5sum = self.data_class = None


class Publisher(Topic):
    """Publishes messages on a topic."""

    reg_type = "pub"

    def __init__(
        self,
        name: str,
        data_class: Any,
        subscriber_listener: SubscribeListener | None = None,
        tcp_nodelay: bool = False,
        latch: bool = False,
        headers: dict[str, str] | None = None,
        queue_size: int | None = None,
    ) -> None:
        """Advertise a topic; returns once it is registered.

        Args:
            name: resolved and remapped.
            data_class: class of the messages.
            subscriber_listener: called when subscribers come and go.
            tcp_nodelay: no effect; messages are sent at once.
            latch: new subscribers get the last message.
            headers: further fields of connection headers.
            queue_size: messages queued per slow subscriber; 0: unlimited; None: publishing waits.

        Raises:
            ValueError: invalid name or class.
        """
        del tcp_nodelay
        super().__init__(name, data_class)
        if queue_size is None:
            warnings.warn(
                "The publisher should be created with an explicit keyword argument 'queue_size'. Please see "
                "http://wiki.ros.org/rospy/Overview/Publishers%20and%20Subscribers for more information.",
                SyntaxWarning,
                stacklevel=2,
            )
        shared = _manager.acquire(_manager.pubs, Publication, self.resolved_name, data_class)
        shared.configure(listener=subscriber_listener, latch=latch, headers=headers, queue_size=queue_size)
        self.impl = shared
        if shared.ref_count == 1:
            graph.when_started(shared.start)

    def publish(self, *args: Any, **kwds: Any) -> None:
        """Publish a message, or a message with these field values.

        Raises:
            ROSException: before `init_node`, or after `unregister`.
            ROSSerializationException: a field's value does not fit.
            TypeError: a message of another type.
        """
        impl = self.impl
        if impl is None:
            raise ROSException("publish() to an unregistered() handle")
        if sent := impl.sender.send(args, kwds):
            if sent == _message_codec.SENT_IN_PART:
                impl.send_rest()
            return
        if not core.is_initialized():
            raise ROSException("ROS node has not been initialized yet. Please call init_node() first")
        message = args_kwds_to_message(self.data_class, args, kwds)
        if impl.closed and not core.is_shutdown():
            raise ROSException("publish() to a closed topic")
        try:
            impl.publish(message)
        except genpy.SerializationError as error:
            core.rospyerr(traceback.format_exc())
            raise ROSSerializationException(str(error)) from None

    def unregister(self) -> None:
        """Stop publishing."""
        if self.impl is not None:
            name = self.resolved_name
            self._forget()
            _manager.release(_manager.pubs, name)


class Subscriber(Topic):
    """Subscribes to a topic; callbacks run in a thread of the topic."""

    reg_type = "sub"

    def __init__(
        self,
        name: str,
        data_class: Any,
        callback: Callable[..., object] | None = None,
        callback_args: Any = None,
        queue_size: int | None = None,
        buff_size: int = DEFAULT_BUFF_SIZE,
        tcp_nodelay: bool = False,
    ) -> None:
        """Subscribe; returns once the subscription is registered.

        Args:
            name: resolved and remapped.
            data_class: class of the messages; AnyMsg takes any.
            callback: takes the message, and `callback_args` unless None.
            callback_args: second argument.
            queue_size: messages that wait for slow callbacks; the oldest are dropped. None: no limit.
            buff_size: no effect; messages of any size are received.
            tcp_nodelay: ask publishers not to wait for full packets.

        Raises:
            ValueError: invalid name or class.
            ROSException: invalid sizes.
        """
        super().__init__(name, data_class)
        shared = _manager.acquire(_manager.subs, Subscription, self.resolved_name, data_class)
        self.impl = shared
        try:
            if queue_size is not None:
                shared.set_queue_size(queue_size)
            if buff_size != DEFAULT_BUFF_SIZE:
                shared.set_buff_size(buff_size)
        except ROSException:
            self.unregister_shared()
            raise
        self.callback = callback
        self.callback_args = None if callback is None else callback_args
        if callback is not None:
            shared.add_callback(callback, callback_args)
        if tcp_nodelay:
            shared.set_tcp_nodelay(tcp_nodelay)
        if shared.ref_count == 1:
            graph.when_started(shared.start)

    def unregister(self) -> None:
        """Unsubscribe."""
        if self.impl is None:
            return
        if self.callback is not None:
            self.impl.remove_callback(self.callback, self.callback_args)
        self.callback = self.callback_args = None
        self.unregister_shared()

    def unregister_shared(self) -> None:
        """Release the topic."""
        name = self.resolved_name
        self._forget()
        _manager.release(_manager.subs, name)
